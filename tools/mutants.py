#!/usr/bin/env python3
"""Plants plausible mistakes one by one, and sees whether the tests notice.

Usage: mutants.py [--check] [--jobs N] [--only WHICH] [--copy DIR] [ROOT]

tools/mutants.toml lists the mistakes: a file, a text that occurs in it once, what stands there instead, and the tests
that have to fail. They are planted in a copy of the working tree, which is built by itself once; ROOT is only read. A
mistake is killed by tests that fail, crash or do not end. Prints a line for each and a table of the areas, and ends with
what is not killed and the reason where the list has one; exits 1 where fewer than 95 % are killed.

--check     only sees that every text occurs exactly once, so that the list stays true to the sources
--jobs N    so many compilers at a time (all cores)
--only W    only mistakes in whose area, file or meaning this regular expression is found
--copy DIR  where the copy is or comes to be (build/mutants)
"""
import argparse
import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import tomllib

WANTED_SHARE = 0.95
# Fewer would say little.
FEWEST = 70
# Tests that are changed may take longer without hanging: so many times what they take unchanged, and so many seconds.
PATIENCE, LEAST_PATIENCE = 8, 20


def read_list(root):
    with open(root / "tools/mutants.toml", "rb") as file:
        return tomllib.load(file)["mutant"]


def faults_of(root, mutants):
    """What is wrong with the list, one line each."""
    faults = [] if len(mutants) >= FEWEST else [f"{len(mutants)} mutants; there should be {FEWEST} at least"]
    seen = set()
    for m in mutants:
        name = f"{m['file']}: {m['text']!r}"
        path = root / m["file"]
        count = path.read_text().count(m["text"]) if path.is_file() else 0
        if count != 1:
            faults.append(f"{name} occurs {count} times")
        if m["text"] == m["with"] or (name, m["with"]) in seen:
            faults.append(f"{name} is nothing new")
        seen.add((name, m["with"]))
        for test in m["tests"]:
            layer = test.partition(":")[0].removesuffix("_test")
            if not (root / "tests" / layer).is_dir():
                faults.append(f"{name}: no such tests: {test}")
    return faults


def sources(root):
    """Relative names of all files but those of builds."""
    skipped = {".git", "build", "out", "node_modules"}
    for top in root.iterdir():
        if top.name not in skipped:
            yield from (p.relative_to(root) for p in ([top] if top.is_file() else top.rglob("*")) if p.is_file())


def copy_tree(root, tree):
    """What is the same is not touched, so that it is not built again."""
    tree.mkdir(parents=True, exist_ok=True)
    wanted = set(sources(root))
    for name in wanted:
        source, target = root / name, tree / name
        if not target.is_file() or target.read_bytes() != source.read_bytes():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)
    for name in set(sources(tree)) - wanted:
        (tree / name).unlink()


class Workshop:
    """The copy of the tree and its build."""

    def __init__(self, root, tree, jobs):
        self.root, self.tree, self.jobs = root, tree, jobs
        self.usual_time = {}

    def run(self, command, **options):
        return subprocess.run(command, cwd=self.tree, capture_output=True, text=True, errors="replace", **options)

    def build(self, programs):
        """Empty, or what the compiler says."""
        targets = [f"bin/{program}" for program in programs]
        built = self.run(["ninja", "-C", "build/release", "-j", str(self.jobs)] + targets)
        return "" if built.returncode == 0 else built.stdout

    def prepare(self, mutants):
        copy_tree(self.root, self.tree)
        made = self.run(["cmake", "--preset", "release", "-DPELAGE_TESTS=ON", "-DPELAGE_BENCHMARKS=OFF"])
        if made.returncode != 0:
            sys.exit("mutants: " + made.stdout + made.stderr)
        tests = {test for m in mutants for test in m["tests"]}
        if said := self.build(sorted({program(test) for test in tests})):
            sys.exit("mutants: the sources as they are do not build\n" + said)
        for test in sorted(tests):
            begin = time.monotonic()
            if failed := self.failure(test, 3600):
                sys.exit(f"mutants: {test} fails without any mistake: {failed}")
            self.usual_time[test] = time.monotonic() - begin

    def failure(self, test, seconds):
        """The first test that fails, or how the program ends; empty if all is well."""
        name, _, chosen = test.partition(":")
        try:
            done = self.run([f"build/release/bin/{name}", "--gtest_brief=1", "--gtest_fail_fast",
                             "--gtest_filter=" + (chosen or "*")], timeout=seconds)
        except subprocess.TimeoutExpired:
            return f"{name} does not end"
        if done.returncode == 0:
            return "" if " 0 tests " not in done.stdout else f"{test} names no test"
        failed = re.search(r"\[  FAILED  \] ([\w/.]+)", done.stdout)
        return failed[1] if failed else f"{name} ends with {done.returncode}"

    def plant(self, mutant):
        """What becomes of a mistake: a pair of a word and, where it is killed, the test that did it."""
        path = self.tree / mutant["file"]
        text = path.read_text()
        path.write_text(text.replace(mutant["text"], mutant["with"]))
        try:
            if said := self.build(sorted({program(test) for test in mutant["tests"]})):
                return "does not compile", next((line for line in said.splitlines() if "error:" in line), "")
            for test in mutant["tests"]:
                if failed := self.failure(test, LEAST_PATIENCE + PATIENCE * self.usual_time[test]):
                    return "killed", failed
            return "survived", ""
        finally:
            path.write_text(text)


def program(test):
    return test.partition(":")[0]


def line_of(root, mutant):
    text = (root / mutant["file"]).read_text()
    return text.count("\n", 0, text.index(mutant["text"])) + 1


def print_table(results):
    areas = collections.defaultdict(list)
    for mutant, outcome in results:
        areas[mutant["area"]].append(outcome)
    print(f"\n{'area':<28} mutants  killed")
    for area, outcomes in areas.items():
        print(f"{area:<28} {len(outcomes):>7} {outcomes.count('killed'):>7}")


def main():
    parser = argparse.ArgumentParser(usage=__doc__.splitlines()[2].removeprefix("Usage: "))
    parser.add_argument("root", nargs="?", default=pathlib.Path(__file__).resolve().parent.parent, type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--only", default="")
    parser.add_argument("--copy", type=pathlib.Path)
    options = parser.parse_args()
    root = options.root.resolve()

    mutants = read_list(root)
    if faults := faults_of(root, mutants):
        sys.exit("\n".join("tools/mutants.toml: " + fault for fault in faults))
    if options.check:
        return
    mutants = [m for m in mutants if re.search(options.only, " ".join([m["area"], m["file"], m["what"]]))]
    workshop = Workshop(root, (options.copy or root / "build/mutants").resolve(), options.jobs)
    print(f"building {workshop.tree}, and running the tests without any mistake", flush=True)
    workshop.prepare(mutants)
    results = []
    for number, mutant in enumerate(mutants, 1):
        begin = time.monotonic()
        outcome, detail = workshop.plant(mutant)
        results.append((mutant, outcome))
        seconds = round(time.monotonic() - begin)
        print(f"{number:>3} {mutant['file']}:{line_of(root, mutant)}: {mutant['what']}: {outcome}"
              f"{' by' if outcome == 'killed' else ''} {detail} ({seconds} s)", flush=True)
    print_table(results)
    killed = sum(outcome == "killed" for _, outcome in results)
    print(f"{killed} of {len(results)} are killed ({100 * killed / max(len(results), 1):.1f} %)")
    for mutant, outcome in results:
        if outcome != "killed":
            print(f"{outcome}: {mutant['file']}:{line_of(root, mutant)}: {mutant['what']}; "
                  f"{mutant.get('survives', 'a test is missing')}")
    sys.exit(0 if killed >= WANTED_SHARE * len(results) else 1)


if __name__ == "__main__":
    main()
