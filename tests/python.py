"""rt.h from Python (docs/python.md): the same structs, functions and pictures as in C.
Usage, in a folder with rt.h and the files of docs/python: tests/python.py PAGE
"""
import ctypes
import doctest
import hashlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.getcwd())
import rt  # noqa: E402

CC = os.environ.get("CC", "cc")


def run(source, *flags):
    subprocess.run([CC, *flags, "-o", "program", "-x", "c", "-", "-lm"],
                   input=source, text=True, check=True)
    return subprocess.run("./program", check=True, capture_output=True, text=True).stdout


def zero(kind):
    """The initialiser with a 0 for each field. C wants all of them, see below."""
    if issubclass(kind, ctypes.Array):
        return "{0}"
    if not issubclass(kind, ctypes.Structure):
        return "0"
    return "{" + ", ".join(zero(part) for _, part in kind._fields_) + "}"


def structs():
    """Each struct of rt.h has its class, of the same size; each field its place, size and kind."""
    here, zeros, code = [], [], []
    for name, kind in rt.kinds.items():
        if kind and not issubclass(kind, ctypes.Structure):
            here.append(f"{name} {ctypes.sizeof(kind)} {kind is ctypes.c_float:d}")
            code.append(f'printf("{name} %zu %d\\n", sizeof({name}),'
                        f" _Generic(({name})0, float: 1, default: 0));")
    with open("rt.h", encoding="utf-8") as header:
        ends = re.findall(r"^} (rt_[a-z]\w*);", header.read(), re.M)
    assert len(ends) > 25
    for name in ends:
        s = rt.kinds.get(name)
        assert s or name == "rt_bvh_row", f"{name} has no class"  # a union
        if not s or not issubclass(s, ctypes.Structure):
            continue
        assert getattr(rt, name[3:].title().replace("_", "")) is s
        here.append(f"{name} {ctypes.sizeof(s)}")
        code.append(f'printf("{name} %zu\\n", sizeof({name}));')
        zeros.append(f"const {name} no_{name} = {zero(s)};")
        for field, kind in s._fields_:
            place = getattr(s, field)
            here.append(f"{name}.{field} {place.offset} {place.size} {kind is ctypes.c_float:d}")
            code.append(f'printf("{name}.{field} %zu %zu %d\\n", offsetof({name}, {field}),'
                        f" sizeof no_{name}.{field},"
                        f" _Generic(no_{name}.{field}, float: 1, default: 0));")
    for name, value in vars(rt).items():
        if name.startswith("RT_"):
            here.append(f"{name} {value}")
            code.append(f'printf("{name} %d\\n", {name});')
    # A field that is missing where C leaves a gap changes no size: hence the zeros.
    there = run('#include "rt.h"\n#include <stddef.h>\n#include <stdio.h>\n' + "\n".join(zeros)
                + "\nint main(void) {" + "\n".join(code) + "}",
                "-std=c11", "-Werror=missing-field-initializers").splitlines()
    assert len(here) > 150
    different = [f"rt.py: {a}, rt.h: {b}" for a, b in zip(here, there) if a != b]
    assert not different and len(here) == len(there), "\n".join(different)


def functions():
    """Each public function that a compiler finds in rt.h can be found from Python."""
    subprocess.run(["gcc", "-O0", "-fkeep-inline-functions", "-DRT_IMPLEMENTATION", "-c",
                    "-o", "rt.o", "-x", "c", "rt.h"], check=True)
    symbols = subprocess.run(["nm", "rt.o"], check=True, stdout=subprocess.PIPE, text=True).stdout
    found = 0
    for kind, name in (line.split()[-2:] for line in symbols.splitlines()):
        if kind in "tT" and name.startswith("rt_") and not name.startswith("rt__"):
            found += 1
            rt.function(name)
    assert found > 70, found
    arguments = (rt.Vec3(), rt.Vec3(0, 1, 0))
    rt.function("rt_reflect")(*arguments)
    for wrong in arguments[:1], (*arguments, 1), (arguments[0], rt.Ray()):
        try:
            rt.function("rt_reflect")(*wrong)
            assert False, "wrong arguments were taken"
        except (TypeError, ctypes.ArgumentError):
            pass


def cores():
    """rt.h uses all cores, and as many lanes as this processor has."""
    count = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 1
    if count > 1 and not {"OMP_NUM_THREADS", "OMP_THREAD_LIMIT"} & set(os.environ):
        assert rt.function("rt_thread_count")(0) > 1, "one core"
    native = subprocess.run([CC, "-march=native", "-dM", "-E", "-x", "c", os.devnull],
                            check=True, stdout=subprocess.PIPE, text=True).stdout
    if all(f"__{it}__" in native for it in ("AVX512VL", "AVX512BW", "AVX512DQ", "FMA")):
        assert rt.function("rt_lane_count")(0) == 16, "not for this processor"


def compiled():
    """rt.h is compiled when it has changed, and only then; a failure does no harm."""
    folder = pathlib.Path("toy")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    shutil.copy("rt.py", folder)
    program = ("try: import rt; print(rt.function('rt_number')(1))\n"
               "except Exception as e: print(type(e).__name__, e)")

    def header(number, time):
        text = "static inline int rt_number(int n) { return n * %d; }\n" % number
        (folder / "rt.h").write_text(text)
        for name in "rt.h", "rt.py":
            os.utime(folder / name, (time, time))

    def compiler(script):  # in place of CC
        path = folder / "compiler"
        path.write_text("#!/bin/sh\n" + script)
        path.chmod(0o755)
        return str(path.resolve())

    def start(cc):
        return subprocess.Popen([sys.executable, "-c", program], cwd=folder, text=True,
                                stdout=subprocess.PIPE, env={**os.environ, "CC": cc})

    def answer(cc=CC):
        return start(cc).communicate()[0].strip()

    now = time.time()
    # It writes half a library and then fails.
    fails = compiler('while [ "$1" != -o ]; do shift; done\n'
                     'echo half >"$2"; echo "line 7: a mistake" >&2; exit 1')
    header(1, now - 100)
    assert answer(fails) == "ImportError line 7: a mistake", answer(fails)
    assert answer() == "1", "after the compiler has failed: " + answer()
    assert answer(fails) == "1", "compiled again, although nothing has changed"
    header(2, now + 100)
    assert answer() == "2", "not compiled again, although rt.h has changed"
    header(3, now - 100)
    os.utime(folder / "rt.py", (now + 100, now + 100))
    assert answer() == "3", "not compiled again, although rt.py has changed"
    for library in folder.glob("*.so"):
        library.unlink()
    slow = compiler(f'{CC} "$@" && sleep 1')
    both = [start(slow), start(slow)]
    answers = [process.communicate()[0].strip() for process in both]
    assert answers == ["3", "3"], f"two at once: {answers}"


def picture():
    """The smallest program writes the same file in Python and in C."""
    hashes = []
    with open("rt.h", encoding="utf-8") as header:
        text = header.read()
    text = text[text.index("THE SMALLEST COMPLETE PROGRAM"):text.index("* WHAT IT IS ")]
    program = [line[7:] for line in text.splitlines() if line.startswith(" *     ")]
    for write in (lambda: run("\n".join(program), "-O2", "-fopenmp", "-ffp-contract=off"),
                  lambda: subprocess.run([sys.executable, "picture.py"], check=True)):
        if os.path.exists("picture.ppm"):
            os.remove("picture.ppm")
        write()
        with open("picture.ppm", "rb") as file:
            hashes.append(hashlib.sha256(file.read()).hexdigest())
    assert hashes[0] == hashes[1], f"the picture in C and in Python: {hashes}"
    print("picture.ppm", hashes[0])


def bits():
    """The library for this machine gives the bits of a program for any machine."""
    floats = run("""
        #define RT_IMPLEMENTATION
        #include "rt.h"
        #include <stdio.h>
        int main(void)
        {
            static rt_vec3 pixels[64 * 48];
            const rt_sphere spheres[] = {{{0, 0, -5}, 1, {{0.8f, 0.8f, 0.8f}, true}},
                                         {{0, -101, -5}, 100, {{0.5f, 0.7f, 0.9f}, false}}};
            const rt_light light = {{3, 4, -2}, {150, 150, 150}};
            const rt_scene scene = {.spheres = spheres, .sphere_count = 2, .lights = &light,
                                    .light_count = 1, .background = {0.25f, 0.5f, 1}};
            const rt_camera camera = {0};
            const rt_options options = {.bounces = 5};
            rt_image image = {.width = 64, .height = 48, .pixels = pixels};
            if (rt_render(&scene, &camera, &options, &image)) return 1;
            for (int i = 0; i < 64 * 48; i++)
                printf("%a %a %a\\n", pixels[i].x, pixels[i].y, pixels[i].z);
            return 0;
        }""", "-O2", "-ffp-contract=off").split()
    scene = rt.scene(spheres=[((0, 0, -5), 1, ((0.8, 0.8, 0.8), True)),
                              ((0, -101, -5), 100, ((0.5, 0.7, 0.9), False))],
                     lights=[((3, 4, -2), (150, 150, 150))], background=(0.25, 0.5, 1))
    image, pixels = rt.image(64, 48)
    rt.render(scene, rt.Camera(), image, bounces=5)
    assert [float.fromhex(f) for f in floats] == [float(f) for f in pixels.flat], "other bits"


def page(path):
    """What the page shows as typed gives the answers that it shows."""
    with open(path, encoding="utf-8") as file:
        text = file.read().replace("```", "")
    test = doctest.DocTestParser().get_doctest(text, {}, path, path, 0)
    assert len(test.examples) > 10
    assert doctest.DocTestRunner().run(test).failed == 0, "see above"
    noise = subprocess.run([sys.executable, "noise.py"], check=True, text=True,
                           stdout=subprocess.PIPE).stdout
    assert noise in text, "the page does not show what noise.py prints:\n" + noise


def refused():
    """Arguments of render in the wrong order are refused, and NULL in the words of rt.h."""
    scene, camera, (image, _) = rt.scene(), rt.Camera(), rt.image(4, 4)
    for wrong in (camera, scene, image), (scene, image, camera), (image, camera, scene):
        try:
            rt.render(*wrong)
            assert False, "arguments in the wrong order were taken"
        except ctypes.ArgumentError:
            pass
    for wrong in (None, camera, image), (scene, None, image), (scene, camera, None):
        try:
            rt.render(*wrong)
            assert False, "None was taken"
        except rt.Error as error:
            assert "NULL" in str(error), error
    assert image.samples == 0
    ball = ((0, 0, -5), 1, ((0.8, 0.8, 0.8), False))
    for wrong in {"sphere": [ball]}, {"spheres": [1]}, {"spheres": ball}, {"background": 1}:
        try:
            rt.scene(**wrong)
            assert False, f"a scene of {wrong}"
        except (AttributeError, TypeError, RuntimeError):
            pass


def new_picture():
    """After rt_image_clear, another scene leaves no trace of the one before."""
    white, blue = rt.scene(background=(1, 1, 1)), rt.scene(background=(0, 0, 1))
    image, pixels = rt.image(4, 4)
    rt.render(white, rt.Camera(), image)
    rt.function("rt_image_clear")(image)
    assert image.samples == 0 and image.rays == 0
    rt.render(blue, rt.Camera(), image)
    assert (pixels == (0, 0, 1)).all(), "a ghost"


def bar():
    """The bar goes forward to its end, and not beyond."""
    class Bar:
        n, steps = 0, []

        def __init__(self, **options):
            pass

        def update(self, more):
            Bar.steps.append(more)
            self.n += more
            Bar.end = self.n

        def close(self):
            pass

    ball = ((0, 0, -5), 1, ((0.8, 0.8, 0.8), False))
    scene = rt.scene(spheres=[ball], background=(1, 1, 1))
    image, _ = rt.image(320, 240)
    real, rt.tqdm = rt.tqdm, Bar
    samples = 16
    while len(Bar.steps) < 4:  # until it takes long enough to see it
        Bar.steps.clear()
        samples *= 2
        rt.render(scene, rt.Camera(), image, samples=samples, bounces=5)
    rt.tqdm = real
    assert min(Bar.steps) >= 0 and max(Bar.steps) < 0.9, Bar.steps
    assert abs(Bar.end - 1) < 1e-6, f"the bar ends at {Bar.end}"


def stopped_by(exception, start=lambda: None):
    """A picture that is stopped keeps its samples, and goes on to the same bits."""
    ball = ((0, 0, -5), 1, ((0.8, 0.8, 0.8), False))
    scene = rt.scene(spheres=[ball], background=(1, 1, 1))
    image, pixels = rt.image(320, 240)
    start()
    try:
        rt.render(scene, rt.Camera(), image, samples=4096, bounces=5)
        assert False, "it was not stopped"
    except exception:
        pass
    kept = pixels.copy()
    time.sleep(0.2)
    assert (kept == pixels).all(), "it still renders"
    assert 0 < image.samples + image.done and image.samples < 4096
    rt.render(scene, rt.Camera(), image, samples=2, bounces=5)
    whole, expected = rt.image(320, 240)
    rt.render(scene, rt.Camera(), whole, samples=image.samples, bounces=5)
    assert (pixels == expected).all(), "not the bits of a picture without the stop"


def stopped():
    class BrokenBar:
        breaks, n = True, 0

        def __init__(self, **options):
            pass

        def close(self):
            pass

        def update(self, more):
            if self.breaks:
                BrokenBar.breaks = False
                raise ZeroDivisionError

    signal.signal(signal.SIGINT, signal.default_int_handler)  # in the background it is ignored

    def soon():
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()

    stopped_by(KeyboardInterrupt, soon)  # with tqdm, if it is there
    rt.tqdm = BrokenBar
    stopped_by(ZeroDivisionError)


structs()
functions()
cores()
compiled()
picture()
bits()
page(sys.argv[1])
refused()
new_picture()
bar()
stopped()
