"""The demos for Windows, run by wine: the pictures, files, Ctrl-C and the window.

    tests/windows.py    one line for each test that fails

Needs wine, "make windows" and the same demos for this system in build/; for the window also
Xvfb and xdotool, see tests/window.py.
"""
import os
import pty
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time

BUILD = os.path.abspath(os.environ.get("BUILD", "build"))
WORK = tempfile.mkdtemp()
HERE = os.path.join(WORK, "the demos, à côté")  # spaces, and letters that are no ASCII
os.environ.update(WINEPREFIX=os.path.join(WORK, "wine"), WINEDEBUG="-all",
                  WINEDLLOVERRIDES="mscoree=d;mshtml=d;winemenubuilder.exe=d")
SMALL = ("48", "36", "--samples", "4", "--quiet", "--no-window", "--out")


def demo(name, *words):
    """Run it in HERE: exit status, and what it printed."""
    done = subprocess.run(["wine", name + ".exe", *words], cwd=HERE, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=60, check=False)
    return done.returncode, done.stdout.decode(errors="replace").replace("\r\n", "\n")


def expected(name):
    """The bytes that it writes on this system."""
    out = os.path.join(WORK, "expected.png")
    subprocess.run([os.path.join(BUILD, name), *SMALL, out], check=True)
    return read(out)


def read(name):
    with open(os.path.join(HERE, name), "rb") as file:
        return file.read()


def write(name, words):
    with open(os.path.join(HERE, name), "w") as file:
        file.write(words)


def parts():
    return [name for name in os.listdir(HERE) if name.endswith(".part")]


def in_terminal(keys, seconds, *words):
    """Run a demo alone in a terminal, press keys after some seconds: status, what it printed."""
    pid, terminal = pty.fork()
    if pid == 0:
        os.chdir(HERE)
        os.execvp("wine", ["wine", *words])
    said, start = b"", time.monotonic()
    while time.monotonic() < start + 60:
        if select.select([terminal], [], [], 0.1)[0]:
            try:
                said += os.read(terminal, 65536)
            except OSError:  # it is closed
                break
        if keys and time.monotonic() > start + seconds:
            os.write(terminal, keys)
            keys = None
    else:
        os.kill(pid, signal.SIGKILL)
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]), said.decode(errors="replace")


def test_pictures_are_the_same_bytes():
    for name in ["demo%02d" % number for number in range(1, 18)]:
        assert demo(name, *SMALL, name + ".png") == (0, ""), name
        assert read(name + ".png") == expected(name), name


def test_a_file_is_replaced():
    for name in ("old.png", "déjà vu.png"):
        write(name, "old")
        code, said = demo("demo05", *(word for word in SMALL if word != "--quiet"), name)
        assert code == 0 and "wrote " + name in said, said
        assert read(name) == expected("demo05") and not parts()


def test_what_cannot_be_written():
    os.makedirs(os.path.join(HERE, "d.png"))
    for name, why in (("/proc/a.png", "No such file"), ("none\\a.png", "No such file"),
                      ("d.png", "Is a directory"), ("a?.png", "Invalid argument"),
                      (300 * "n" + ".png", "File")):
        code, said = demo("demo01", *SMALL, name)
        assert code == 1 and said.startswith("demo01: cannot write '%s': %s" % (name, why)), said
        assert said.count("\n") == 1 and not parts(), said


def test_a_file_that_another_program_has_open():
    write("open.png", "old")
    other = subprocess.Popen(["wine", "cmd", "/c", "ping -n 30 127.0.0.1 <open.png >nul & rem"], cwd=HERE)
    time.sleep(3)
    code, said = demo("demo05", *SMALL, "open.png")
    assert code == 1 and said == ("demo05: cannot write 'open.png': another program has the "
                                  "file open; the picture is in '.rt-1.part'\n"), said
    assert read("open.png") == b"old" and read(".rt-1.part") == expected("demo05")
    os.remove(os.path.join(HERE, ".rt-1.part"))
    other.kill()


def test_ctrl_c_saves():
    code, said = in_terminal(b"\x03", 3, "demo07.exe", "96", "72", "--samples", "9999999",
                             "--no-window", "--out", "c.png")
    assert code == 130, said
    assert read("c.png")[-8:-4] == b"IEND" and not parts()


def test_a_terminal_that_would_vanish_waits():
    start = time.monotonic()
    code, said = in_terminal(b"\r", 4, "demo05.exe", "none")
    assert code == 2 and time.monotonic() > start + 4, said
    start = time.monotonic()
    assert in_terminal(b"\r", 20, "demo05.exe", *SMALL, "g.png")[0] == 0
    assert time.monotonic() < start + 20


def test_the_window():
    """It opens, shows text, answers keys and mouse, saves, and ends."""
    if not shutil.which("Xvfb") or not shutil.which("xdotool"):
        print("note: Xvfb or xdotool is missing: no window under wine")
        return
    end_wine()  # the next one takes the display of the window
    write("demo07", '#!/bin/sh\nexec wine "$0.exe" "$@"\n')
    os.chmod(os.path.join(HERE, "demo07"), 0o755)
    os.environ.update(DEMOS=HERE, SDL_RENDER_DRIVER="software")  # wine's Direct3D is slow here
    from window import Display, Window, until
    display = Display()
    try:
        window = Window(display, "demo07", *SMALL[:4])
        window.wait("7 indirect light .*, 4 samples")
        for stage in "375":
            window.key(stage)
            window.wait("- %s .*, 4 samples, error" % stage)
            assert window.save()[0] == expected("demo0" + stage), "stage " + stage
        window.click(100, 70)
        until(lambda: "camera ray meets" in window.said())
        window.xdotool("keydown", "b")
        window.wait("held: the chapter before")
        window.xdotool("keyup", "b")
        said = window.end()[1]
        assert "no text" not in said, said
    finally:
        display.close()


def end_wine():
    subprocess.run(["wineserver", "-k"], check=False)
    subprocess.run(["wineserver", "-w"], check=False)


def main():
    failed, tests = 0, [name for name in globals() if name.startswith("test_")]
    shutil.copytree(os.path.join(BUILD, "windows"), HERE)
    try:
        subprocess.run(["wineboot", "-i"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                       env=dict(os.environ, DISPLAY=""), timeout=300, check=True)
        for name in tests:
            try:
                globals()[name]()
            except (AssertionError, OSError, subprocess.SubprocessError) as error:
                failed += 1
                print("%s: %s" % (name, str(error) or "wrong"))
                if getattr(error, "stdout", None):
                    print(error.stdout.decode())
        print("windows: %d passed, %d failed" % (len(tests) - failed, failed))
        return failed != 0
    finally:
        end_wine()
        shutil.rmtree(WORK, ignore_errors=True)


sys.exit(main())
