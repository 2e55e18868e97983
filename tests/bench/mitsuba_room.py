#!/usr/bin/env python3
"""How fast Mitsuba 3 renders the room, or a scene of tests/references, on one thread.

  mitsuba_room.py scalar_rgb|llvm_ad_rgb [SCENE]

prints millions of samples per second and the mean colour. The scene is that of tests/references, which is
the one of demos/scene.h. llvm first compiles the scene: neither that nor building it is counted.
"""
import os, sys, time
import drjit as dr
import mitsuba as mi

sys.dont_write_bytecode = True
REFERENCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "references")
sys.path.insert(0, REFERENCES)
import make_references as ref

WIDTH, HEIGHT = 320, 240
SAMPLES = {"scalar_rgb": 4, "llvm_ad_rgb": 16}
if len(sys.argv) > 2: # they are small: let it have more at a time
    WIDTH, HEIGHT, SAMPLES = 160, 120, {"scalar_rgb": 8, "llvm_ad_rgb": 128}

variant = sys.argv[1]
mi.set_variant(variant)
dr.set_thread_count(1)
name = sys.argv[2] if len(sys.argv) > 2 else "B_report_indirect"
s = ref.read_scene(os.path.join(REFERENCES, "scenes", name + ".json"))
s.update(width=WIDTH, height=HEIGHT, sampler="independent")
scene, integrator = mi.load_dict(ref.build(s)), ref.integrator(s)
best = float("inf")
for run in range(3):                    # the first one compiles
    start = time.perf_counter()
    image = mi.render(scene, integrator=integrator, spp=SAMPLES[variant], seed=run).numpy()
    best = min(best, time.perf_counter() - start)
mean = image.mean((0, 1))
print(f"{WIDTH * HEIGHT * SAMPLES[variant] / best / 1e6:.5f}\t{mean[0]:.6f} {mean[1]:.6f} {mean[2]:.6f}")
