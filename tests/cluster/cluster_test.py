#!/usr/bin/env python3
"""Builds a few hundred designs with samples/cluster/ on a real Slurm of three nodes, one of which dies, and by GNU
parallel on two ssh hosts, one of which dies; all must end with the bytes of a run on one machine.

    cluster_test.py --popupc build/release/popupc [--designs 240] [--keep]

Exit status: 0 all is as it must be; 1 something is not; 77 skipped, with the reason.
"""

import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from designs import outputs, tree, write_designs
from process_tree import adopt_orphans, kill_below, reap, send
from ssh_hosts import SshHosts
from virtual_slurm import VirtualSlurm, missing_packages

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPTS = f"{SOURCE}/samples/cluster"
DEADLINE = 180  # seconds for any one run; they take ten


class Failure(Exception):
    """What is not as it must be."""


def say(text):
    print(f"cluster: {text}", flush=True)


def expect(so, otherwise):
    if not so:
        raise Failure(otherwise)


class Step:
    """Says what is done and how long it took."""

    def __init__(self, what):
        self._what = what

    def __enter__(self):
        self._begin = time.monotonic()

    def __exit__(self, kind, *_):
        if kind is None:
            say(f"{self._what} ({time.monotonic() - self._begin:.1f} s)")


class Run:
    """A command in the background, its output in a file."""

    def __init__(self, command, directory, environment, log):
        self.log = log
        self._end = time.monotonic() + DEADLINE
        # Shares and options of an outer Slurm or GNU parallel are not ours.
        clean = {
            key: value for key, value in os.environ.items() if not key.startswith(("SLURM", "SBATCH", "PARALLEL"))
        }
        with open(log, "wb") as file:
            self._process = subprocess.Popen(
                command, cwd=directory, env={**clean, **environment}, stdin=subprocess.DEVNULL, stdout=file, stderr=file,
                # What ran this in its background had interrupts ignored, and a shell cannot trap what it began with.
                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
            )  # fmt: skip

    def going_on(self):
        expect(time.monotonic() < self._end, f"no end after {DEADLINE} s\n{self.said()}")
        return self._process.poll() is None

    def exit(self):
        while self.going_on():
            time.sleep(0.05)
        return self._process.returncode

    def end_with(self, sign):
        self._process.send_signal(sign)
        return self.exit()

    def said(self):
        with open(self.log, encoding="utf-8", errors="replace") as file:
            return file.read()

    def wait_until(self, what, is_so):
        while not is_so():
            expect(self.going_on(), f"the run ended before {what}\n{self.said()}")
            time.sleep(0.01)


def of_popupc(processes):
    """Those of the processes that are popupc, as pids."""
    return [pid for pid, name in processes if name.startswith("popupc")]


def task_of(pid):
    """The index of the array's task that the process belongs to; None when it has ended."""
    try:
        with open(f"/proc/{pid}/environ", "rb") as file:
            found = re.search(rb"(?:^|\0)SLURM_ARRAY_TASK_ID=(\d+)", file.read())
    except OSError:
        return None
    return int(found[1]) if found else None


def halt_midway(run, machine, manifest, tasks):
    """Waits until a task on the machine has built a part of its share, and stops popupc there. Returns its pids.

    Nothing that is stopped goes on meanwhile, so that what is killed then leaves a share undone for certain.
    """
    while True:
        expect(run.going_on(), f"the run ended before its machine was at work\n{run.said()}")
        pids = of_popupc(machine.processes())
        send(signal.SIGSTOP, pids)
        task = next(filter(None, map(task_of, pids)), None)
        if task is not None:
            share = outputs(manifest, slice(task - 1, None, tasks))
            there = {name for name in share if os.path.exists(f"{os.path.dirname(manifest)}/{name}")}
            if 0 < len(there) < len(share):
                return pids
        send(signal.SIGCONT, pids)
        time.sleep(0.01)


def built(directory):
    return sum(len(names) for _, _, names in os.walk(f"{directory}/out"))


def expect_same(directory, reference, manifest):
    """Every output that the manifest names is there, nothing else is, and all bytes are those of the reference."""
    ours, theirs = tree(f"{directory}/out"), tree(f"{reference}/out")
    absent = {name for name in outputs(manifest) if name.removeprefix("out/") not in ours}
    expect(not absent, f"{len(absent)} outputs are absent, such as {sorted(absent)[:3]}")
    others = sorted(set(ours) ^ set(theirs))
    expect(not others, f"{len(others)} files are there in one run only, such as {others[:3]}")
    different = sorted(name for name, data in ours.items() if data != theirs[name])
    expect(not different, f"{len(different)} outputs differ from those of one machine, such as {different[:3]}")
    say(f"all {len(ours)} outputs are there, and equal to those of one machine byte for byte")


def test_slurm(popupc, scratch, single, count):
    directory = f"{scratch}/the cluster's run, 100%a"  # as one word everywhere
    manifest = write_designs(f"{SOURCE}/samples", directory, count)
    reference = len(outputs(manifest))
    with Step("Slurm is up with three nodes"):
        slurm = VirtualSlurm(f"{scratch}/slurm", ["n1", "n2", "n3"]).__enter__()
    try:
        environment = {**slurm.environment, "POPUPC": popupc, "POLL": "1"}
        command = [f"{SCRIPTS}/submit.sh", "jobs.jsonl", "12"]
        with Step(f"submit.sh built {count} designs in 12 tasks"):
            run = Run(command, directory, environment, f"{scratch}/submit.log")

            # The death of a node, in the middle of its work.
            run.wait_until("a tenth was built", lambda: built(directory) > reference / 10)
            halt_midway(run, slurm.machines["n2"], manifest, 12)
            victims = slurm.machines.pop("n2").pull_the_plug()
            say(f"killed n2 with {built(directory)} of {reference} outputs written: " + ", ".join(victims.values()))

            # The death of the connection to the login node.
            run.end_with(signal.SIGHUP)
            lost = run.said()
            run = Run(command, directory, environment, f"{scratch}/submit-2.log")
            run.wait_until("it found the array", lambda: "builds this manifest already" in run.said())
            say("ended submit.sh as a lost connection does; started again, it found the array that goes on")

            # The death of a task, as at a lack of memory: Slurm does not start it again.
            run.wait_until("a third was built", lambda: built(directory) > reference / 3)
            victims = halt_midway(run, slurm.machines["n3"], manifest, 12)
            send(signal.SIGKILL, victims)
            say(f"killed the {len(victims)} processes of popupc on n3 with {built(directory)} outputs written")
            status = run.exit()
        if status != 0:
            raise Failure(f"submit.sh ended with {status}\n{run.said()}\n{slurm.logs()}")
        for line in (lost + run.said()).splitlines():
            say(f"  | {line}")
        expect("round 1: " in run.said(), "nothing was submitted again")
        states = slurm.states()
        expect(states["n2"].startswith("down"), f"Slurm thinks that its dead node is {states['n2']}")
        expect_same(directory, single, manifest)
        expect(not os.path.exists(f"{directory}/jobs.missing.jsonl"), "a manifest of what is missing was left")

        with Step("submit.sh built again only the one design that was changed"):
            before = {name: os.stat(f"{directory}/{name}") for name in outputs(manifest)}
            with open(f"{directory}/designs/000-castle.xml", "a", encoding="utf-8") as file:
                file.write("<!-- changed -->\n")
            again = Run(command, directory, environment, f"{scratch}/again.log")
            expect(again.exit() == 0, f"submit.sh ended with {again.exit()}\n{again.said()}")
            rebuilt = {
                name for name, was in before.items()
                if (now := os.stat(f"{directory}/{name}")).st_mtime_ns != was.st_mtime_ns or now.st_ino != was.st_ino
            }  # fmt: skip
            expect(rebuilt == outputs(manifest, slice(1)), f"it built {sorted(rebuilt)}")

        with Step("submit.sh cancelled its array on Ctrl-C"):
            cancelled = f"{scratch}/cancelled"
            write_designs(f"{SOURCE}/samples", cancelled, 100)
            run = Run([f"{SCRIPTS}/submit.sh", "jobs.jsonl", "10"], cancelled, environment, f"{scratch}/cancelled.log")
            run.wait_until("something was built", lambda: built(cancelled))
            status = run.end_with(signal.SIGINT)
            expect(status == 130, f"submit.sh ended with {status}\n{run.said()}")
            slurm.until("the queue is empty", lambda: not slurm.run("squeue", "-h").stdout)

        with Step("submit.sh tells what cannot be built, and does not try for ever"):
            bad = f"{scratch}/bad"
            good_manifest = write_designs(f"{SOURCE}/samples", bad, 6)
            bad_manifest = f"{bad}/with-bad.jsonl"
            shutil.copy(good_manifest, bad_manifest)
            with open(f"{bad}/designs/bad-cut-short.xml", "w", encoding="utf-8") as file:
                file.write('<popup version="2.0" units="mm"><mainpage width="100"')
            with open(bad_manifest, "a", encoding="utf-8") as file:
                file.write('{"input": "designs/bad-cut-short.xml", "output": "out/bad-cut-short.svg"}\n')
            wrong = Run([f"{SCRIPTS}/submit.sh", bad_manifest], scratch, environment, f"{scratch}/bad.log")
            expect(wrong.exit() == 1, f"submit.sh ended with {wrong.exit()}\n{wrong.said()}\n{slurm.logs()}")
            expect("bad-cut-short" in wrong.said() and "round 2" not in wrong.said(), wrong.said())
            with open(f"{bad}/with-bad.missing.jsonl", encoding="utf-8") as file:
                missing = file.read()
            expect(missing.count("\n") == 1 and "bad-cut-short" in missing, f"said to be missing: {missing}")
            built_names = {f"out/{name}" for name in tree(f"{bad}/out")}
            expect(outputs(good_manifest) <= built_names, "one that cannot be built has kept others from it")
            expect("out/bad-cut-short.svg" not in built_names, "something was written of what cannot be built")
    finally:
        slurm.stop()


def test_parallel(popupc, scratch, single, count):
    if shutil.which("parallel") is None:
        say("skipped: GNU parallel is not installed (apt-get install parallel); parallel.sh was not tried")
        return
    directory = f"{scratch}/parallel's run"  # as one word everywhere
    manifest = write_designs(f"{SOURCE}/samples", directory, count)
    reference = len(outputs(manifest))
    with SshHosts(f"{scratch}/ssh", ["alpha", "beta"]) as hosts:
        if not hosts.real:
            say("sshd is not installed, or this is not root: a command stands in for ssh")
        command = [f"{SCRIPTS}/parallel.sh", "jobs.jsonl", *hosts.names]
        with Step(f"parallel.sh built {count} designs on two hosts"):
            run = Run(command, directory, {**hosts.environment, "POPUPC": popupc}, f"{scratch}/parallel.log")
            run.wait_until("a quarter was built", lambda: built(directory) > reference / 4)
            run.wait_until("beta was at work", lambda: of_popupc(hosts.processes("beta")))
            victims = hosts.kill("beta")
            expect(of_popupc(victims.items()), f"beta was idle when it died: {victims}")
            say(f"killed beta with {built(directory)} of {reference} outputs written: " + ", ".join(victims.values()))
            status = run.exit()
        expect(status == 0, f"parallel.sh ended with {status}\n{run.said()}")
        expect_same(directory, single, manifest)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--popupc", required=True)
    parser.add_argument("--designs", type=int, default=240)
    parser.add_argument("--keep", action="store_true", help="leave the scratch directory")
    arguments = parser.parse_args()
    popupc = os.path.abspath(arguments.popupc)

    lacking = missing_packages()
    if lacking:
        say(f"skipped: not installed: apt-get install {' '.join(lacking)}")
        return 77
    adopt_orphans()
    for sign in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(sign, lambda number, _: sys.exit(128 + number))  # by way of all that cleans up
    begin = time.monotonic()
    scratch = tempfile.mkdtemp(prefix="popupc-cluster-")
    os.chmod(scratch, 0o755)  # munge's socket must be reached by those who use it
    try:
        single = f"{scratch}/single"
        write_designs(f"{SOURCE}/samples", single, arguments.designs)
        with Step(f"popupc batch built {arguments.designs} designs on one machine"):
            alone = Run([popupc, "batch", "jobs.jsonl"], single, {}, f"{scratch}/single.log")
            expect(alone.exit() == 0, f"popupc batch ended with {alone.exit()}\n{alone.said()}")
        test_slurm(popupc, scratch, single, arguments.designs)
        test_parallel(popupc, scratch, single, arguments.designs)
    except (Failure, RuntimeError) as failure:
        say(f"FAILED: {failure}")
        return 1
    finally:
        kill_below(os.getpid())
        reap()
        if arguments.keep:
            say(f"kept: {scratch}")
        else:
            shutil.rmtree(scratch, ignore_errors=True)
    say(f"passed ({time.monotonic() - begin:.1f} s)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
