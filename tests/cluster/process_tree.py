"""Processes that are machines: everything such a machine ever starts stands below one process, so that its plug can be
pulled, and so that nothing outlives a test.

Linux gives an orphan to the nearest ancestor that asked for orphans (PR_SET_CHILD_SUBREAPER). That holds for daemons
that fork twice, begin a session of their own and rename themselves.
"""

import ctypes
import os
import signal
import subprocess
import sys
import time

PR_SET_PDEATHSIG = 1
PR_SET_CHILD_SUBREAPER = 36


def _prctl(option, value):
    ctypes.CDLL(None).prctl(option, value, 0, 0, 0)


def adopt_orphans():
    """Makes this process the parent of whatever its descendants leave behind."""
    _prctl(PR_SET_CHILD_SUBREAPER, 1)


def descendants(of):
    """The processes that `of` started, and those that they started, as (pid, name); zombies are left out."""
    children = {}
    for entry in os.listdir("/proc"):
        if not entry.isdigit():
            continue
        try:
            with open(f"/proc/{entry}/stat", encoding="utf-8", errors="replace") as file:
                text = file.read()
        except OSError:
            continue  # it has ended
        name = text[text.index("(") + 1 : text.rindex(")")]
        state, parent = text[text.rindex(")") + 2 :].split()[:2]
        children.setdefault(int(parent), []).append((int(entry), name, state))
    found = []
    todo = [of]
    while todo:
        for pid, name, state in children.get(todo.pop(), []):
            todo.append(pid)
            if state != "Z":
                found.append((pid, name))
    return found


def send(sign, pids):
    """Sends a signal to each process that is still there."""
    for pid in pids:
        try:
            os.kill(pid, sign)
        except ProcessLookupError:
            pass


def kill_below(root):
    """kill -9 for all descendants of `root`, until none is left. Returns what was killed as {pid: name}."""
    killed = {}
    end = time.monotonic() + 10
    while alive := descendants(root):
        killed.update(alive)
        # What is stopped starts nothing new meanwhile.
        send(signal.SIGSTOP, dict(alive))
        send(signal.SIGKILL, dict(alive))
        if time.monotonic() > end:
            raise RuntimeError(f"{alive} cannot be killed")
        time.sleep(0.005)
    return killed


class Machine:
    """A process that runs `command` and keeps all that comes of it below itself, until its plug is pulled."""

    def __init__(self, command, environment, log):
        with open(log, "ab") as file:
            self._process = subprocess.Popen(
                [sys.executable, os.path.abspath(__file__), *command],
                env=environment, stdin=subprocess.DEVNULL, stdout=file, stderr=file, start_new_session=True,
            )  # fmt: skip

    def processes(self):
        """What runs on it, as (pid, name)."""
        return descendants(self._process.pid)

    def ended(self):
        """Its command's exit status, or None while that runs."""
        return self._process.poll()

    def pull_the_plug(self):
        """kill -9 for everything on it. Returns what was killed as {pid: name}."""
        killed = kill_below(self._process.pid)
        self._process.kill()
        self._process.wait()
        return killed


def reap():
    """Takes leave of orphans that were adopted and have ended. For when no process of one's own is waited for."""
    try:
        while os.waitpid(-1, os.WNOHANG)[0] != 0:
            pass
    except ChildProcessError:
        pass


def _be_a_machine(command):
    adopt_orphans()
    parent = os.getppid()

    def end(*_):
        kill_below(os.getpid())
        os._exit(1)

    signal.signal(signal.SIGTERM, end)
    _prctl(PR_SET_PDEATHSIG, signal.SIGTERM)  # a test that was killed itself leaves nothing running
    if os.getppid() != parent:
        end()
    main = subprocess.Popen(command)  # pylint: disable=consider-using-with
    while True:
        pid, status = os.wait()  # orphans too: somebody has to
        if pid == main.pid:
            kill_below(os.getpid())
            sys.exit(os.waitstatus_to_exitcode(status) or 1)


if __name__ == "__main__":
    _be_a_machine(sys.argv[1:])
