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
text = re.sub(r"/\*.*?\*/", "", header.read_text(encoding="utf-8"), flags=re.S)
functions = {name: (result, arguments) for result, name, arguments in re.findall(
    r"^(?:static inline|RTDEF) ([^(\n]*)\b(rt_[a-z]\w*)\(([^)]*)\)", text, re.M)}
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

kinds = {"void": None, "bool": C.c_bool, "char": C.c_ubyte, "int": C.c_int, "float": C.c_float,
         "uint32_t": C.c_uint32, "uint64_t": C.c_uint64, "double": C.c_double}
RT_ALL_BOUNCES = 2 ** 31 - 1
for name, values in re.findall(r"typedef enum (rt_[a-z]\w*) {(.*?)}", text, re.S):
    kinds[name] = C.c_int
    globals().update((value, i) for i, value in enumerate(re.findall(r"\w+", values)))
structs = dict(re.findall(r"typedef struct (rt_[a-z]\w*) {(.*?)}", text, re.S))


def kind(text):
    """The type that rt.h calls, for example, "const rt_ray *ray"."""
    name, star = re.match(r"\s*(?:const |struct |unsigned )*(\w+) ?(\*?)", text).groups()
    return C.POINTER(kinds.get(name)) if star else kinds[name]


def fields(text):
    """Of a struct, each with its name and type: "float u, v" are two."""
    for field in re.findall(r"[^;\s][^;]*", text):
        if "(" in field:  # a pointer to a function
            result, name, arguments = re.match(r"(.*?)\(\*(\w+)\)\((.*)\)", field).groups()
            yield name, C.CFUNCTYPE(kind(result), *map(kind, arguments.split(",")))
            continue
        for name, count in re.findall(r"(\w+)(?:\[(\d+)\])?(?=,|$)", field):
            yield name, kind(field) * int(count) if count else kind(field)


for name in structs:  # rt_custom_shape becomes CustomShape
    kinds[name] = type(name, (C.Structure,), {"__slots__": ()})
    globals()[name[3:].title().replace("_", "")] = kinds[name]
for name in structs:  # now that they may contain each other
    kinds[name]._fields_ = list(fields(structs[name]))


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


def scene(**given):
    """A scene. Lists become arrays, and the scene gets their lengths, too."""
    made, kinds = Scene(), dict(Scene._fields_)
    for name, value in given.items():
        item = getattr(kinds.get(name), "_type_", None)
        if item and isinstance(value, (list, tuple)):
            following = list(kinds)[list(kinds).index(name) + 1]
            if following.endswith("_count"):
                setattr(made, following, len(value))
            value = (item * len(value))(*value)
        setattr(made, name, value)
    return made


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

    options = Options(progress=dict(Options._fields_)["progress"](progress), **options)
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
