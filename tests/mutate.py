#!/usr/bin/env python3
"""Mutation test: change rt.h in one place at a time; a test must go red.

  tests/mutate.py                every mutant, some 20 minutes on 2 cores
  tests/mutate.py --every N      every Nth, for a quick look
  tests/mutate.py --survivors    those of tests/survivors.txt only: do they still live?

A mutant that does not compile does not count. One that no test catches, a survivor, is printed
and must be in tests/survivors.txt with the reason why it may live; exit 1 if one is not, or if
fewer than 90 % are caught. Needs gcc, cmocka and cJSON."""
import argparse, concurrent.futures, os, re, shutil, subprocess, sys, tempfile

TESTS = ["00_vectors", "01_sphere", "02_walls", "03_cube", "04_shadows", "05_gamma", "06_mirror",
         "07_monte_carlo", "08_pictures", "12_many_shapes", "13_packets", "14_less_noise",
         "15_one_pixel",
         "10_references"]
SWAPS = [("<", "<="), ("<=", "<"), (">", ">="), (">=", ">"), ("==", "!="), ("!=", "=="),
         ("&&", "||"), ("||", "&&"), ("+", "-"), ("-", "+"), ("*", "/"), ("/", "*"),
         ("true", "false"), ("false", "true"), ("0.0f", "1.0f"), ("1.0f", "2.0f"),
         ("0.5f", "0.6f"), ("2.0f", "3.0f"), ("1", "2"), ("0", "1"), ("0.0", "1.0"), ("1.0", "2.0"),
         ("++", "--"), ("!", "")]
HERE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def mutants(lines):
    """(line number, changed line, number of its test) for each swap in the functions of rt.h."""
    inside = comment = aside = False
    first = "00"
    for n, line in enumerate(lines):
        m = re.match(r" \* (Chapter \d|The machinery|Packets)", line)
        if m:
            first = {"Chapter 8": "12", "Chapter 9": "14", "The machinery": "08",
                     "Packets": "13"}.get(m.group(1), "0" + m.group(1)[-1])
        text = re.sub(r"/\*.*?\*/", lambda m: " " * len(m.group()), line)
        if comment:
            comment = "*/" not in text
            continue
        if "/*" in text:
            comment, text = True, text[:text.index("/*")]
        if text.startswith("#"):                        # what is for builds without OpenMP
            aside = text.startswith("#else") and ("clock" in lines[n + 1] or "wanted" in lines[n + 1])
            continue
        if aside:
            continue
        if text.startswith("{"):
            inside = True
        if text.startswith("}"):
            inside = False
        if not inside or '"' in text:
            continue
        for old, new in SWAPS:
            pattern = (r"(?<![\w.])" + re.escape(old) + r"(?![\w.])" if old[0].isalnum()
                       else r"(?<![<>=!+*/&|-])" + re.escape(old) + r"(?![<>=+*/&|-])")
            for m in re.finditer(pattern, text):
                if old == "-" and text[m.end():m.end() + 1] == ">":
                    continue
                if old == "*" and text[m.start() - 1:m.end() + 1] not in (" * ", " *"):
                    continue                            # a pointer
                yield n, line[:m.start()] + new + line[m.end():], first


def run(job):
    """The name of the test that catches the mutant, "" if none, None if it does not compile."""
    lines, (n, changed, first) = job
    folder = tempfile.mkdtemp()
    try:
        shutil.copytree(f"{HERE}/demos", f"{folder}/demos")
        shutil.copytree(f"{HERE}/tests", f"{folder}/tests", ignore=shutil.ignore_patterns("references"))
        os.symlink(f"{HERE}/tests/references", f"{folder}/tests/references")
        with open(f"{folder}/rt.h", "w") as f:
            f.write("\n".join(lines[:n] + [changed] + lines[n + 1:]))
        order = sorted(TESTS, key=lambda t: (t[:2] != first, t == "10_references"))
        flags = subprocess.getoutput("pkg-config --cflags --libs cmocka libcjson").split()
        for test in order:
            built = subprocess.run(["gcc", "-std=c99", "-O1", "-ffp-contract=off", "-fopenmp", "-w",
                                    f"tests/{test}.c", "-o", "test", *flags, "-lm"],
                                   cwd=folder, capture_output=True)
            if built.returncode != 0:
                return None
            try:
                if subprocess.run(["./test"], cwd=folder, capture_output=True, timeout=60,
                                  env={**os.environ, "OMP_NUM_THREADS": "2",
                                       "OMP_WAIT_POLICY": "passive"}).returncode != 0:
                    return test
            except subprocess.TimeoutExpired:
                return test
        return ""
    finally:
        shutil.rmtree(folder)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--survivors", action="store_true")
    options = parser.parse_args()
    lines = open(f"{HERE}/rt.h").read().split("\n")
    known = open(f"{HERE}/tests/survivors.txt").read()
    jobs = [(lines, m) for m in list(mutants(lines))[::options.every]
            if not options.survivors or m[1].strip() in known]
    caught = survived = unknown = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for (_, (n, changed, _)), test in zip(jobs, pool.map(run, jobs)):
            if test is None:
                continue
            if test:
                caught += 1
                if options.survivors:
                    print(f"caught by {test}: {changed.strip()}", flush=True)
                continue
            survived += 1
            if changed.strip() not in known:
                unknown += 1
                print(f"survivor: {lines[n].strip()}\n      as: {changed.strip()}", flush=True)
    total = caught + survived
    print(f"{total} mutants, {caught} caught ({100 * caught / total:.1f} %), {survived} survived, "
          f"{unknown} of them not in tests/survivors.txt")
    sys.exit(caught > 0 if options.survivors else unknown > 0 or caught < 0.9 * total)


main()
