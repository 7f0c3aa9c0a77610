"""A Python process that does one run after another (`serve`), from the side of its parent.

A run is one long step, and nothing stops a step from outside but the end of its process. So a run that takes too long
costs its process, and the next run starts another. Not by joblib or multiprocessing: they start no processes in the
workers of Dask, which are daemons.
"""

import os
import pickle
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from multiprocessing.connection import wait

from jostle_lab.errors import LabError
from jostle_lab.runs.build import Performed, too_long
from jostle_lab.runs.run import Run

START_LIMIT = 60.0
"""Longest time until a new process answers [s]: it imports numpy and pandas, perhaps from a slow disk."""
LAST_WORDS = 2000
"""Characters of the messages of a process that died."""


class Child:
    """The process; for one thread at a time."""

    def __init__(self) -> None:
        self._messages = tempfile.TemporaryFile()  # noqa: SIM115 - as long as the process
        words = [sys.executable, "-m", "jostle_lab.runs.serve"]
        # A group of its own: Ctrl-C goes to the parent alone, which decides.
        self._process = subprocess.Popen(
            words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._messages, process_group=0
        )
        assert self._process.stdin is not None and self._process.stdout is not None
        self._requests, self._answers = self._process.stdin, self._process.stdout
        self._spent = 0.0  # processor time so far
        self._ending = threading.Lock()
        self.version: str
        """`simulated.version` there."""
        try:
            if not wait([self._answers.fileno()], START_LIMIT):
                raise EOFError
            self.version, self._spent = pickle.load(self._answers)
        except EOFError:
            ended = self.stop()
            raise LabError(
                f"{socket.gethostname()}: no process for runs could be started with {sys.executable}. {ended} Is the "
                "package jostle there? Make it: scripts/setup, or pip install jostle; or name a program with --program."
            ) from None
        except BaseException:
            self.stop()
            raise

    @property
    def alive(self) -> bool:
        """Whether it was not stopped and did not die."""
        return self._process.returncode is None

    def perform(self, run: Run, limit: float | None) -> Performed:
        """Do a run, for at most `limit` [s] on the clock; that it takes longer, or its process dies, is its error."""
        begun = time.perf_counter()
        before, outputs = self._spent, {}
        try:
            pickle.dump(run, self._requests)
            self._requests.flush()
            if wait([self._answers.fileno()], limit):
                outputs, error, self._spent = pickle.load(self._answers)
            else:
                self.stop()
                error = too_long(limit or 0.0)
        except (EOFError, BrokenPipeError):
            error = self.stop()
        except BaseException:
            self.stop()
            raise
        return Performed(outputs, error, self._spent - before, time.perf_counter() - begun)

    def kill(self) -> None:
        """End the process at once; any thread may, and the one that uses it is told that it died."""
        with self._ending:
            if self.alive:
                os.kill(self._process.pid, signal.SIGKILL)

    def stop(self) -> str:
        """End the process at once, wherever it is, and give up what belongs to it; return how it ended."""
        with self._ending:
            if self.alive:
                # By hand, since Popen does not tell the processor time. One that ends already keeps its exit code.
                os.kill(self._process.pid, signal.SIGKILL)
                _, status, usage = os.wait4(self._process.pid, 0)
                self._process.returncode = os.waitstatus_to_exitcode(status)
                self._spent = usage.ru_utime + usage.ru_stime
        for pipe in (self._requests, self._answers):
            with suppress(BrokenPipeError):
                pipe.close()
        self._messages.seek(0)
        messages = self._messages.read().decode(errors="replace").strip()[-LAST_WORDS:]
        self._messages.close()
        return f"Its process ended with code {self._process.returncode}. {messages}".strip()


class Children:
    """The processes of this one, lent to one thread each, started when they are needed."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._idle: list[Child] = []
        self._lent: set[Child] = set()

    @contextmanager
    def lent(self) -> Iterator[Child]:
        """A process that lives."""
        with self._lock:
            child = self._idle.pop() if self._idle else None
        if child is None:
            child = Child()
        with self._lock:
            self._lent.add(child)
        try:
            yield child
        finally:
            with self._lock:
                self._lent.discard(child)
                if child.alive:
                    self._idle.append(child)

    def end(self) -> None:
        """End all: those that are idle, and at once those that are lent."""
        with self._lock:
            idle, self._idle = self._idle, []
            lent = list(self._lent)
        for child in idle:
            child.stop()
        for child in lent:
            child.kill()
