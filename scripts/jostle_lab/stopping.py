"""How a command is stopped: Ctrl-C, SIGTERM and a closed terminal in one way.

    signal -> native programs are ended -> Stopped is raised in the main thread -> what is kept is told -> exit code

`Stopped` is a KeyboardInterrupt: code that cleans up after Ctrl-C cleans up after SIGTERM. Not here: processes in
Python (`protocol.workers`), which end by themselves when the process that started them does.
"""

import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from subprocess import Popen
from typing import Any

Program = Popen[bytes]

SIGNALS: dict[int, str] = {
    int(getattr(signal, name)): said
    for name, said in (("SIGINT", "Ctrl-C"), ("SIGTERM", "SIGTERM"), ("SIGHUP", "the end of the terminal"))
    if hasattr(signal, name)
}
"""What stops a command, and what it is called."""
PATIENCE = 2.0
"""Time to clean up [s]; a signal that comes later ends the process at once."""


class Stopped(KeyboardInterrupt):
    """The user, or whoever runs this command, wants it to end."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


class _State:
    """Of this process: there is one main thread, and one command."""

    number: int | None = None
    """Of the signal that has come."""
    since = 0.0
    told = False
    deferred = False
    """The main thread starts a program at this moment."""
    on_stop: set[Callable[[], None]] = set()  # noqa: RUF012 - the state of the process
    """What is called at once when a signal comes."""


def check() -> None:
    """Raise `Stopped` if a signal has come."""
    if _State.number is not None:
        raise Stopped(_State.number)


def check_ended_by(code: int) -> None:
    """Raise `Stopped` if a program with this exit code was ended by a signal that also came here, or comes at once.

    Ctrl-C goes to every process of a terminal, and no order is promised.
    """
    if -code in SIGNALS:
        for _ in range(20):
            check()
            time.sleep(0.01)
    check()


@contextmanager
def running(start: Callable[[], Program]) -> Iterator[Program]:
    """The program that `start` starts, from any thread; a signal kills it at once, and whatever leaves the block early.

    Raises `Stopped` if a signal has come. One that comes while the program starts acts when it can be killed.
    """
    check()
    deferring = threading.current_thread() is threading.main_thread()
    if deferring:
        _State.deferred = True
    try:
        program = start()
        _State.on_stop.add(program.kill)
    finally:
        if deferring:
            _State.deferred = False
    try:
        check()
        yield program
    except BaseException:
        program.kill()
        program.wait()
        raise
    finally:
        _State.on_stop.discard(program.kill)


@contextmanager
def telling(kept: Callable[[], str]) -> Iterator[None]:
    """If what is inside is stopped, say why, what is kept, and how to go on: the text of `kept`."""
    try:
        yield
    except KeyboardInterrupt as error:
        number = error.number if isinstance(error, Stopped) else int(signal.SIGINT)
        _say(f"\nstopped by {SIGNALS[number]}. {kept()}\n")
        raise


def _say(text: str) -> None:
    """Once for each signal: the innermost knows best."""
    if _State.number is not None:
        if _State.told:
            return
        _State.told = True
    try:
        sys.stderr.write(text)
        sys.stderr.flush()
    except OSError:
        return  # the terminal is gone


def _handle(number: int, _frame: Any) -> None:
    if _State.number is None:
        _State.number, _State.since = number, time.monotonic()
        for end in list(_State.on_stop):
            end()
        if not _State.deferred:
            raise Stopped(number)
        return
    if time.monotonic() - _State.since > PATIENCE:
        os._exit(128 + number)


def _wait_for_threads() -> None:
    """Threads whose programs were ended remove their temporary folders; the end of the process would cut that off."""
    deadline = time.monotonic() + 0.5 * PATIENCE
    while _State.on_stop and time.monotonic() < deadline:
        time.sleep(0.01)
    time.sleep(0.1)


@contextmanager
def stoppable() -> Iterator[None]:
    """In the main thread: a command that signals stop. It ends with exit code 128 + the number of the signal."""
    before = {}
    for number in SIGNALS:
        # What is ignored from outside stays ignored: nohup.
        if signal.getsignal(number) is not signal.SIG_IGN:
            before[number] = signal.signal(number, _handle)
    try:
        yield
    except (KeyboardInterrupt, SystemExit):
        # Typer makes an exit code of its own of KeyboardInterrupt.
        if _State.number is None:
            raise
        said = "Files that are written already stay; the command may be repeated."
        _say(f"\nstopped by {SIGNALS[_State.number]}. {said}\n")
        raise SystemExit(128 + _State.number) from None
    finally:
        if _State.number is not None:
            _wait_for_threads()
        for number, handler in before.items():
            signal.signal(number, handler)
        _State.number, _State.told = None, False
