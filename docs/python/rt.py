"""rt.h from Python. Keep this file beside rt.h, which it compiles when it is imported."""
import ctypes as C, os, pathlib, platform, re, subprocess
from concurrent.futures import ThreadPoolExecutor, wait
import numpy as np
try:
    from tqdm.auto import tqdm
except ImportError:
    class tqdm:  # shows nothing
        n = 0
        __init__ = update = close = lambda self, *more, **options: None

me = pathlib.Path(__file__).resolve()
header, built = me.with_name("rt.h"), me.with_name(f"rt-{platform.node()}.so")
functions = {name: (result, arguments) for result, name, arguments in re.findall(
    r"^(?:static inline|RTDEF) ([^(\n]*)\b(rt_[a-z]\w*)\(([^)]*)\)",
    header.read_text(encoding="utf-8"), re.M)}
changed = max(me.stat().st_mtime, header.stat().st_mtime)
if not built.exists() or built.stat().st_mtime < changed:
    # Most functions are static inline: what can be seen is a pointer to each.
    source = '#define RT_IMPLEMENTATION\n#include "rt.h"\n' + "".join(
        f"void (*const at_{f})(void) = (void (*)(void)){f};\n" for f in functions)
    new = f"{built}.{os.getpid()}"  # of its own: two notebooks may do this at once
    flags = "-O2 -march=native -fopenmp -ffp-contract=off -shared -fPIC -x c - -lm"
    cc = subprocess.run(
        [os.environ.get("CC", "cc"), "-I", me.parent, "-o", new, *flags.split()],
        input=source, text=True, capture_output=True)
    if cc.returncode:
        raise ImportError(cc.stderr)
    os.replace(new, built)
library = C.CDLL(str(built))


def struct(name, **fields):
    """The struct of this name in rt.h; all its fields, in their order."""
    members = {"_fields_": list(fields.items()), "__slots__": ()}
    kinds[name] = type(name, (C.Structure,), members)
    return kinds[name]


Float, Int, Bool, To = C.c_float, C.c_int, C.c_bool, C.POINTER
kinds = {"void": None, "bool": Bool, "char": C.c_ubyte, "int": Int, "rt_status": Int,
         "uint32_t": C.c_uint32, "float": Float, "double": C.c_double}
Progress = C.CFUNCTYPE(Bool, C.c_void_p, Float)
Vec3 = struct("rt_vec3", x=Float, y=Float, z=Float)
DVec3 = struct("rt_dvec3", x=C.c_double, y=C.c_double, z=C.c_double)
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
Guide = struct("rt_guide", normal=Vec3, point=Vec3, albedo=Vec3, direct=Vec3, half=Vec3)
Image = struct("rt_image", width=Int, height=Int, pixels=To(Vec3), samples=Int, done=Int,
               rays=C.c_uint64, half=To(Vec3), rest=To(Vec3), guides=To(Guide),
               first=Int, count=Int)
Lens = struct("rt_lens", radius=Float, focus=Float)
Options = struct("rt_options", samples=Int, bounces=Int, threads=Int, seed=C.c_uint32,
                 progress=Progress, user=C.c_void_p, sampler=Int, error=Float,
                 seconds=Float, lanes=Int, lens=Lens)


def kind(text):
    """The type of what rt.h calls, for example, "const rt_ray *ray"."""
    name, star = re.match(r"\s*(?:const |struct |unsigned )*(\w+) ?(\*?)", text).groups()
    return To(kinds.get(name)) if star else kinds[name]


def function(name):
    """The function of this name, with the types that rt.h says."""
    result, arguments = functions[name]
    types = [kind(text) for text in arguments.split(",")]
    address = C.c_void_p.in_dll(library, "at_" + name).value
    call = C.CFUNCTYPE(kind(result), *types)(address)

    def checked(*given):  # ctypes itself takes more arguments than there should be
        if len(given) != len(types):
            raise TypeError(f"{name}({arguments}) has {len(types)} arguments")
        return call(*given)
    return checked


def scene(spheres=(), boxes=(), lights=(), **more):
    s = (Sphere * len(spheres))(*spheres)
    b = (Box * len(boxes))(*boxes)
    l = (Light * len(lights))(*lights)
    return Scene(s, len(s), b, len(b), l, len(l), **more)


def image(width, height):
    """A black image, and its pixels as an array of numpy: the same memory."""
    pixels = np.zeros((height, width, 3), np.float32)
    return Image(width, height, (Vec3 * (width * height)).from_buffer(pixels)), pixels


class Error(Exception):
    """What rt_status_text says."""


def render(scene, camera, image, **options):
    """Add samples to the image. After Ctrl-C it has those that were done by then."""
    part, going = 0, True

    def progress(user, now):  # called on the other thread, where no Ctrl-C arrives
        nonlocal part
        part = now
        return going

    options = Options(progress=Progress(progress), **options)
    bar = tqdm(total=1, leave=False, bar_format="{l_bar}{bar}| {remaining} left")
    with ThreadPoolExecutor(1) as other:
        try:
            job = other.submit(function("rt_render"), scene, camera, options, image)
            while wait([job], 0.1).not_done:
                bar.update(part - bar.n)
            bar.update(part - bar.n)
        finally:
            going = False
            bar.close()
    if job.result():
        raise Error(C.string_at(function("rt_status_text")(job.result())).decode())
