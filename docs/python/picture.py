"""The smallest complete program of rt.h, in Python: writes the same picture.ppm."""
import rt

scene = rt.scene(
    spheres=[((0, 0, -5), 1, ((0.85, 0.10, 0.08), False)),
             ((0, -101, -5), 100, ((0.80, 0.80, 0.80), False))],
    lights=[((3, 4, -2), (150, 150, 150))])
image, pixels = rt.image(320, 240)
rt.render(scene, rt.Camera(), image, bounces=5)

encode = rt.function("rt_encode")
with open("picture.ppm", "wb") as file:
    file.write(b"P6 320 240 255\n" + bytes(encode(v, 2.2) for v in pixels.flat))
