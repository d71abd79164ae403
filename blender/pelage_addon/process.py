"""The program pelage as a process: told its words, listened to, and ended. Knows nothing of Blender."""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time

_PROGRESS = re.compile(r"pelage: (.*?)(?: (\d+) %(?:, (.*) left)?)?$")
_SECONDS_TO_END = 5


class Failure(Exception):
    """What went wrong, in words for a user."""


def _popen(command: list, folder) -> subprocess.Popen:
    hidden = {"creationflags": subprocess.CREATE_NO_WINDOW} if sys.platform == "win32" else {}
    try:
        return subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, encoding="utf-8", errors="replace", **hidden)
    except OSError as error:
        raise Failure(f"The program {command[0]} cannot be run: {error.strerror or error}") from error


def _error_in(words: str, code: int) -> str:
    found = re.search(r"^pelage: error: (.*)", words, re.MULTILINE)
    if found:
        return found[1]
    last = words.strip().rsplit("\n", 1)[-1]
    return f"pelage ended with code {code}" + (f": {last}" if last else "")


def answer(program: str, *words: str) -> str:
    """What the program prints, for questions that it answers at once."""
    process = _popen([program, *words], None)
    out, errors = process.communicate()
    if process.returncode:
        raise Failure(_error_in(errors, process.returncode))
    return out


class Job:
    """A run of the program in a temporary folder of its own, which is gone after `close`.

    Whoever starts it asks `running()` now and then, reads `task`, `fraction` and `left`, and at the end `result`.
    """

    def __init__(self):
        self.folder = tempfile.mkdtemp(prefix="pelage-")
        self.task, self.fraction, self.left = "starting", 0.0, ""
        self.warnings = []
        self.cancelled = False
        self._errors, self._output, self._process, self._readers, self._later = [], "", None, [], []

    def start(self, *commands: list):
        """Begins the first command, a list of words with the program first; each other one follows the one before."""
        self._later = list(commands[1:])
        self._process = _popen(commands[0], self.folder)
        self._readers = [threading.Thread(target=read, daemon=True) for read in (self._read_errors, self._read_output)]
        for reader in self._readers:
            reader.start()

    def _read_errors(self):
        for line in self._process.stderr:
            self.hear(line.rstrip("\r\n"))

    def _read_output(self):
        self._output = self._process.stdout.read()

    def hear(self, line: str):
        """A line of what the program says beside its result: a warning, an error, or what it is doing."""
        if line.startswith("pelage: warning: "):
            self.warnings.append(line[len("pelage: warning: "):])
        elif line.startswith("pelage: error: "):
            self._errors.append(line)
        elif progress := _PROGRESS.match(line):
            self.task, percent, left = progress.groups()
            self.fraction, self.left = int(percent or 0) / 100, left or ""
        else:
            self._errors.append(line)

    def running(self) -> bool:
        """Whether there is something to wait for; begins the next command where one has done its part."""
        if self._process is None or self._process.poll() is None:
            return self._process is not None
        if self._process.returncode or self.cancelled or not self._later:
            return False
        self._join()
        self.start(*self._later)
        return True

    def _join(self):
        for reader in self._readers:
            reader.join()

    def result(self) -> dict:
        """What the last command did; raises Failure if any did not end well."""
        while self.running():
            time.sleep(0.02)
        self._join()
        if self.cancelled:
            raise Failure("Cancelled")
        if self._process.returncode:
            raise Failure(_error_in("\n".join(self._errors), self._process.returncode))
        return json.loads(self._output)

    def cancel(self):
        """Asks the program to end; one that does not listen is killed."""
        self.cancelled = True
        if not self.running():
            return
        self._process.terminate()
        try:
            self._process.wait(_SECONDS_TO_END)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def close(self):
        """Nothing is left behind: no process, no files."""
        if self.running():
            self.cancel()
        self._join()
        shutil.rmtree(self.folder, ignore_errors=True)
