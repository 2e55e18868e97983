"""rt.h from Python. Keep this file beside rt.h, which it compiles when it is imported."""
import ctypes as C, os, pathlib, re, subprocess
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import nullcontext
import numpy as np
try:
    from tqdm.auto import tqdm
except ImportError:
    tqdm = None

me = pathlib.Path(__file__).resolve()
header, built = me.with_name("rt.h"), me.with_name("rt_h.so")
time = {f: f.stat().st_mtime if f.exists() else 0 for f in (me, header, built)}
if time[built] < max(time[me], time[header]):
    # The chapters' functions are static inline: what can be seen is a pointer to each.
    text = header.read_text(encoding="utf-8")
    names = re.findall(r"^static inline [^(\n]*\b(rt_[a-z]\w*)\(", text, re.M)
    source = '#define RT_IMPLEMENTATION\n#include "rt.h"\n' + "".join(
        f"void (*const at_{n})(void) = (void (*)(void)){n};\n" for n in set(names))
    new = built.with_suffix(f".{os.getpid()}")
    flags = "-O2 -fopenmp -ffp-contract=off -shared -fPIC -x c - -lm".split()
    subprocess.run([os.environ.get("CC", "cc"), "-I", me.parent, "-o", new, *flags],
                   input=source, text=True, check=True)
    new.replace(built)
library = C.CDLL(str(built))
library.rt_status_text.restype = C.c_char_p


def struct(name, **fields):
    """The struct of this name in rt.h; all its fields, in their order."""
    return type(name, (C.Structure,), {"_fields_": list(fields.items()), "__slots__": ()})


Float, Int, Bool, To = C.c_float, C.c_int, C.c_bool, C.POINTER
Progress = C.CFUNCTYPE(Bool, C.c_void_p, Float)
Vec3 = struct("rt_vec3", x=Float, y=Float, z=Float)
Ray = struct("rt_ray", origin=Vec3, direction=Vec3)
Camera = struct("rt_camera", position=Vec3, direction=Vec3, up=Vec3, fov_y=Float)
Material = struct("rt_material", albedo=Vec3, mirror=Bool)
Sphere = struct("rt_sphere", center=Vec3, radius=Float, material=Material)
Box = struct("rt_box", min=Vec3, max=Vec3, material=Material)
Light = struct("rt_light", position=Vec3, intensity=Vec3)
Hit = struct("rt_hit", t=Float, point=Vec3, normal=Vec3, material=To(Material), shape=Int,
             part=Int, u=Float, v=Float, inside=Bool)
Rng = struct("rt_rng", key=C.c_uint32, dimension=C.c_uint32, rays=C.c_uint32, sobol=Bool,
             sample=C.c_uint32, watch=C.c_void_p)
Scene = struct("rt_scene", spheres=To(Sphere), sphere_count=Int, boxes=To(Box),
               box_count=Int, lights=To(Light), light_count=Int, background=Vec3,
               bvh=C.c_void_p, surfaces=C.c_void_p, lamps=C.c_void_p, lamp_count=Int,
               sky=C.c_void_p, sky_data=C.c_void_p, meshes=C.c_void_p, mesh_count=Int,
               custom_shapes=C.c_void_p, custom_shape_count=Int)
Image = struct("rt_image", width=Int, height=Int, pixels=To(Vec3), samples=Int, done=Int,
               rays=C.c_uint64, half=To(Vec3), rest=To(Vec3), guides=C.c_void_p,
               first=Int, count=Int)
Lens = struct("rt_lens", radius=Float, focus=Float)
Options = struct("rt_options", samples=Int, bounces=Int, threads=Int, seed=C.c_uint32,
                 progress=Progress, user=C.c_void_p, sampler=Int, error=Float,
                 seconds=Float, lanes=Int, lens=Lens)


class Error(Exception):
    """What rt_status_text says."""


def scene(spheres=(), boxes=(), lights=(), **more):
    s, b, l = (Sphere * len(spheres)), (Box * len(boxes)), (Light * len(lights))
    return Scene(s(*spheres), len(spheres), b(*boxes), len(boxes),
                 l(*lights), len(lights), **more)


def image(width, height):
    """A black image, and its pixels as an array of numpy: the same memory."""
    pixels = np.zeros((height, width, 3), np.float32)
    return Image(width, height, (Vec3 * (width * height)).from_buffer(pixels)), pixels


def render(scene, camera, image, **options):
    """Add samples to the image. After Ctrl-C it has those that were done by then."""
    part, going = 0, True

    def progress(user, now):  # called on the other thread, where no Ctrl-C arrives
        nonlocal part
        part = now
        return going

    call = scene, camera, Options(progress=Progress(progress), **options), image
    look = "{l_bar}{bar}| {remaining} left"
    with ThreadPoolExecutor(1) as other, \
            tqdm(total=1, bar_format=look) if tqdm else nullcontext() as bar:
        try:
            job = other.submit(library.rt_render, *map(C.byref, call))
            done = False
            while not done:
                done = wait([job], 0.1).done
                if tqdm:
                    bar.update(part - bar.n)
        finally:
            going = False
    if job.result():
        raise Error(library.rt_status_text(job.result()).decode())


def function(name, result, *arguments):
    """The chapters' function of this name, by the types of its result and arguments."""
    return C.CFUNCTYPE(result, *arguments)(C.c_void_p.in_dll(library, "at_" + name).value)
