"""`python -m jostle_lab.runs.serve`: does the runs that come on standard input, until it is closed.

    first of all -> (version of the package, processor time of this process so far [s])
    a Run        -> (outputs, error, processor time of this process so far [s])

All of it is pickled. The parent of this process is `child.Child`. When it ends, however that is, its end of the pipe
closes, and this process ends, if need be in the middle of a step: the interpreter is free during a step, so that the
thread that reads notices.
"""

import os
import pickle
import sys
import threading
import time
from queue import SimpleQueue
from typing import NoReturn

from jostle_lab.runs.run import Run
from jostle_lab.runs.simulated import JostleError, last_values, version


def _read(runs: "SimpleQueue[Run]") -> NoReturn:
    try:
        while True:
            runs.put(pickle.load(sys.stdin.buffer))
    finally:
        os._exit(0)


def serve() -> NoReturn:
    """Answer until standard input is closed."""
    # Answers go where the standard output was; what anybody prints goes to the messages.
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    runs: SimpleQueue[Run] = SimpleQueue()
    threading.Thread(target=_read, args=[runs], daemon=True).start()
    pickle.dump((version(), time.process_time()), answers)
    answers.flush()
    while True:
        run = runs.get()
        outputs, error = {}, None
        try:
            outputs = last_values(run)
        except JostleError as refused:
            error = str(refused)
        except Exception as defect:  # one run's, which the others go on without
            error = f"{type(defect).__name__}: {defect}"
        pickle.dump((outputs, error, time.process_time()), answers)
        answers.flush()


if __name__ == "__main__":
    serve()
