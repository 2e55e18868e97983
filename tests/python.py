"""rt.h from Python (docs/python.md): the same structs, functions and pictures as in C.
Usage, in a folder with rt.h and the files of docs/python: tests/python.py PAGE
"""
import ctypes
import doctest
import hashlib
import os
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
    if not issubclass(kind, ctypes.Structure):
        return "0"
    return "{" + ", ".join(zero(part) for _, part in kind._fields_) + "}"


def structs():
    """Each struct of rt.py has the size of rt.h's, each field its place, size and kind."""
    here, zeros, code = [], [], []
    for s in vars(rt).values():
        if not (isinstance(s, type) and issubclass(s, ctypes.Structure)):
            continue
        name = s.__name__
        here.append(f"{name} {ctypes.sizeof(s)}")
        code.append(f'printf("{name} %zu\\n", sizeof({name}));')
        zeros.append(f"const {name} no_{name} = {zero(s)};")
        for field, kind in s._fields_:
            place = getattr(s, field)
            here.append(f"{name}.{field} {place.offset} {place.size} {kind is ctypes.c_float:d}")
            code.append(f'printf("{name}.{field} %zu %zu %d\\n", offsetof({name}, {field}),'
                        f" sizeof no_{name}.{field},"
                        f" _Generic(no_{name}.{field}, float: 1, default: 0));")
    # A field that is missing where C leaves a gap changes no size: hence the zeros.
    there = run('#include "rt.h"\n#include <stddef.h>\n#include <stdio.h>\n' + "\n".join(zeros)
                + "\nint main(void) {" + "\n".join(code) + "}",
                "-std=c11", "-Werror=missing-field-initializers").splitlines()
    assert len(here) > 50
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
            rt.function(name, None) if kind == "t" else getattr(rt.library, name)
    assert found > 70, found


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


def page(path):
    """What the page shows as typed gives the answers that it shows."""
    with open(path, encoding="utf-8") as file:
        text = file.read().replace("```", "")
    test = doctest.DocTestParser().get_doctest(text, {}, path, path, 0)
    assert len(test.examples) > 10
    assert doctest.DocTestRunner().run(test).failed == 0, "see above"


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

        def __enter__(self):
            return self

        def __exit__(self, *error):
            pass

        def update(self, more):
            if self.breaks:
                BrokenBar.breaks = False
                raise ZeroDivisionError

    signal.signal(signal.SIGINT, signal.default_int_handler)  # in the background it is ignored

    def soon():
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()

    stopped_by(KeyboardInterrupt, soon)  # with tqdm, if it is there
    rt.tqdm = None
    stopped_by(KeyboardInterrupt, soon)
    rt.tqdm = BrokenBar
    stopped_by(ZeroDivisionError)


structs()
functions()
picture()
page(sys.argv[1])
stopped()
