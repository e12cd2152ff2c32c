#!/usr/bin/env python3
"""Runs the programs of tests/fuzz/targets side by side, and says what they did.

    run.py BUILD MINUTES [TARGET...]

BUILD is the folder that was configured with POPUP_FUZZ. Each target gets its share of the minutes, as many at a time as
there are cores: quick_TARGET, which does not watch memory, has three quarters of it; fuzz_TARGET, which does, has the
rest, and begins with all that the other kept. What a target keeps lies in BUILD/corpus/TARGET, and is where it goes on
next time; what it found, made as small as half a minute allows, in BUILD/finds/TARGET. How many inputs each has looked
at, over all runs, is kept in BUILD/figures.json: with POPUP_FUZZ_UNTIL=10000000 in the environment, a target that has so
many is done, and leaves its time to the others. A find that shows a fault becomes a file in tests/fuzz/finds/TARGET,
where the ordinary tests look at it. Exits with 1 where there are finds, or a target did not run.
"""
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
ROW = re.compile(r'^POPUP_FUZZ_TARGET\((\w+), (\d+), "([^"]*)", "([^"]*)"\)', re.M)
MOST_FINDS = 8  # of one target in one run: then it is for a person to look
SECONDS_A_FIND = 30
# A second of the ordinary program is some ten under the sanitizers, and the other cores are busy.
SECONDS_A_UNIT = int(os.environ.get("POPUP_FUZZ_TIMEOUT", "30"))
MEGABYTES = 2048
# A target that has executed so many inputs, over all runs on a folder, is done; 0: never.
UNTIL = int(os.environ.get("POPUP_FUZZ_UNTIL", "0"))
QUICK = 0.75  # of the time


class Target:
    def __init__(self, build, before, name, longest, seeds, dictionary):
        self.name, self.longest = name, int(longest)
        self.before = before.get(name, 0)  # executions of earlier runs
        self.programs = build / "tests" / "fuzz"
        self.corpus = build / "corpus" / name
        self.finds = build / "finds" / name
        self.log = build / "logs" / f"{name}.log"
        for folder in (self.corpus, self.finds, self.log.parent):
            folder.mkdir(parents=True, exist_ok=True)
        self.dictionary = HERE / "dictionaries" / f"{dictionary}.dict" if dictionary else None
        files = [f for suffix in filter(None, seeds.split()) for folder in ("samples", "tests")
                 for f in (ROOT / folder).rglob("*" + suffix)]
        files += [f for folder in ("seeds", "finds") for f in (HERE / folder / name).glob("*")]
        files = sorted({f for f in files if f.is_file() and f.stat().st_size <= self.longest and "," not in str(f)})
        self.seeds = build / "logs" / f"{name}.seeds"
        self.seeds.write_text(",".join(map(str, files)))
        self.executions = self.watched = self.edges = self.all_edges = self.seconds = 0
        self.found = []  # what is wrong, once each

    def all_executions(self):
        return self.before + self.executions

    def is_done(self):
        return 0 < UNTIL <= self.all_executions()

    def command(self, kind, *options):
        return [str(self.programs / f"{kind}_{self.name}"), f"-timeout={SECONDS_A_UNIT}", f"-rss_limit_mb={MEGABYTES}",
                "-detect_leaks=0", f"-max_len={self.longest}", "-print_final_stats=1", "-print_funcs=0", *options]

    def once(self, kind, seconds):
        """Runs until the time is over or something is found; what was found, or None."""
        before = set(self.finds.iterdir())
        # For each edge of an input libFuzzer goes through its list of rare edges. By default LLVM 14 keeps all edges
        # there that it saw less than 255 times, which takes nine tenths of the time of readers that reach many.
        options = [f"-max_total_time={max(1, int(seconds))}", f"-artifact_prefix={self.finds}/",
                   "-entropic_feature_frequency_threshold=0"]
        if UNTIL:
            # With none left to do, it looks at what the corpus holds.
            options.append(f"-runs={max(0, UNTIL - self.all_executions())}")
        if self.dictionary:
            options.append(f"-dict={self.dictionary}")
        # What is worth keeping of them is in the corpus from then on.
        if self.seeds.stat().st_size and not any(self.corpus.iterdir()):
            options.append(f"-seed_inputs=@{self.seeds}")
        begun = time.monotonic()
        said = run(self.command(kind, *options, str(self.corpus)), seconds + 120)
        self.seconds += time.monotonic() - begun
        with self.log.open("a") as log:
            log.write(said)
        executed = re.findall(r"stat::number_of_executed_units: (\d+)", said)
        count = int(executed[-1]) if executed else max([0, *map(int, re.findall(r"^#(\d+)\t", said, re.M))])
        self.executions += count
        if kind == "fuzz":
            self.watched += count
            self.edges = max([self.edges, *map(int, re.findall(r"\bcov: (\d+)", said))])
            loaded = re.search(r"\((\d+) inline 8-bit counters\)", said)
            self.all_edges = int(loaded.group(1)) if loaded else self.all_edges
        new = [f for f in set(self.finds.iterdir()) - before if not f.name.startswith("slow-unit")]
        for slow in self.finds.glob("slow-unit*"):
            slow.unlink()
        return (new[0], signature(said)) if new else None

    def small(self, kind, find):
        """The find, with as few bytes as half a minute allows."""
        smaller = find.with_name(find.name + "-small")
        run(self.command(kind, "-minimize_crash=1", f"-max_total_time={SECONDS_A_FIND}",
                         f"-exact_artifact_path={smaller}", str(find)), 3 * SECONDS_A_FIND)
        if smaller.exists():
            if smaller.stat().st_size:
                smaller.replace(find)
            else:
                smaller.unlink()

    def fuzz(self, seconds):
        end = time.monotonic() + seconds
        self.look("quick", end - (1 - QUICK) * seconds)
        self.look("fuzz", end)
        return self

    def look(self, kind, end):
        """Goes on until then, or until it found too much."""
        while (left := end - time.monotonic()) > 1 and len(self.found) < MOST_FINDS:
            find = self.once(kind, left)
            if not find:
                break
            path, what = find
            # What one program kept may break the other: it would, again and again, before it looks at anything else.
            (self.corpus / path.name.partition("-")[2]).unlink(missing_ok=True)
            if what in self.found:
                path.unlink()
                # The same again and again: what lies behind it is reached when it is mended.
                if sum(1 for _ in self.finds.iterdir()) > MOST_FINDS:
                    break
                continue
            self.found.append(what)
            if not path.name.startswith("timeout"):
                self.small(kind, path)


def run(words, seconds):
    # Where each piece of memory was allocated takes a quarter of the time to note; who looks at a find runs it again.
    environment = dict(os.environ, UBSAN_OPTIONS="print_stacktrace=1",
                       ASAN_OPTIONS="detect_leaks=0:quarantine_size_mb=16:detect_stack_use_after_return=0:"
                                    "malloc_context_size=1")
    try:
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=seconds, env=environment,
                              cwd="/")
        return done.stdout.decode(errors="replace")
    except subprocess.TimeoutExpired as late:
        return (late.stdout or b"").decode(errors="replace")


def signature(said):
    """What tells one fault from another: what was expected, or where it went wrong."""
    for pattern in (r"^BROKEN: (.*)", r"runtime error: .*", r"Assertion .*", r"^SUMMARY: (.*)"):
        if one := re.search(pattern, said, re.M):
            return re.sub(r"[-+]?\d[\d.e+-]*", "N", one.group(0))
    return "something"


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    build, minutes = pathlib.Path(sys.argv[1]).resolve(), float(sys.argv[2])
    rows = ROW.findall((HERE / "targets" / "targets.inc").read_text())
    wanted = sys.argv[3:] or [row[0] for row in rows]
    if unknown := set(wanted) - {row[0] for row in rows}:
        sys.exit(f"there is no target {', '.join(sorted(unknown))}; there are {' '.join(row[0] for row in rows)}")
    # Executions add up over all runs on a folder.
    figures_file = build / "figures.json"
    figures = json.loads(figures_file.read_text()) if figures_file.exists() else {}
    targets = [Target(build, figures, *row) for row in rows if row[0] in wanted]
    cores = int(os.environ.get("POPUP_FUZZ_JOBS", os.cpu_count() or 1))
    end = time.monotonic() + 60 * minutes
    waiting = [target for target in targets if not target.is_done()]

    def take_turn(target):
        # What those before have left of their time is shared by those that wait.
        share = (end - time.monotonic()) * min(cores, len(waiting)) / len(waiting)
        waiting.remove(target)
        return target.fuzz(share)

    with concurrent.futures.ThreadPoolExecutor(cores) as pool:
        for target in pool.map(take_turn, list(waiting)):
            # Read again: runs on other targets may have written theirs.
            if figures_file.exists():
                figures.update(json.loads(figures_file.read_text()))
            figures[target.name] = target.all_executions()
            figures_file.write_text(json.dumps(figures, indent=1, sort_keys=True) + "\n")

    print(f"{'target':16}{'executions':>12}{'watched':>9}{'a second':>10}{'of all runs':>13}{'edges':>8}{'of':>8}"
          f"{'corpus':>8}{'finds':>7}")
    for target in targets:
        print(f"{target.name:16}{target.executions:12}{target.watched:9}"
              f"{target.executions / max(target.seconds, 1):10.0f}{target.all_executions():13}"
              f"{target.edges:8}{target.all_edges:8}{sum(1 for _ in target.corpus.iterdir()):8}{len(target.found):7}")
    idle = [target for target in targets if not target.executions and not target.found and not target.is_done()]
    for target in idle:
        print(f"{target.name} did not run; the end of {target.log}:")
        print("\n".join("  " + line for line in target.log.read_text(errors="replace").splitlines()[-5:]))
    found = [(target, what) for target in targets for what in target.found]
    for target, what in found:
        print(f"{target.name}: {what}\n  in {target.finds}")
    sys.exit(1 if found or idle else 0)


if __name__ == "__main__":
    main()
