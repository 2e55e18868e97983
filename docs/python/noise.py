"""How fast does the noise fall? The errors of pictures, against one of many samples."""
import numpy as np
import rt

scene = rt.scene(spheres=[((0, 0, -5), 1, ((0.8, 0.8, 0.8), False))],
                 background=(0.25, 0.5, 1))


def picture(samples, **options):
    image, pixels = rt.image(64, 48)
    rt.render(scene, rt.Camera(), image, bounces=5, samples=samples, **options)
    return pixels


exact = picture(2 ** 13, seed=1)
print("samples    Sobol   random")
for samples in (1, 4, 16, 64, 256):
    errors = [np.sqrt(np.mean((picture(samples, sampler=s) - exact) ** 2))
              for s in (rt.RT_SOBOL, rt.RT_RANDOM)]
    print("%7d  %.5f  %.5f" % (samples, *errors))
