"""What the program says of itself: its manual page, answers of commands, documents of its service."""
import contextlib
import http.client
import json
import pathlib
import re
import shutil
import subprocess
import tempfile


class Program:
    """`plenum` with a copy of the catalogue in a folder of its own."""

    def __init__(self, binary, checkout, folder):
        self.binary = str(pathlib.Path(binary).resolve())
        self.checkout = pathlib.Path(checkout)
        self.folder = pathlib.Path(folder)
        shutil.copyfile(self.checkout / "catalog.db", self.folder / "catalog.db")

    def text(self, *words, document=None):
        """Standard output of a command that reads `document` as JSON on standard input."""
        done = subprocess.run([self.binary, *words], cwd=self.folder, capture_output=True, text=True, check=False,
                              input=None if document is None else json.dumps(document))
        if done.returncode != 0:
            raise SystemExit(f"plenum {' '.join(words)} ended with {done.returncode}: {done.stderr}")
        return done.stdout

    def file(self, name, document):
        """The name of a file of the folder that holds the document."""
        (self.folder / name).write_text(json.dumps(document), encoding="utf-8")
        return name

    def answer(self, command, document):
        return json.loads(self.text(command, "-", "--json", document=document))

    def example(self, name):
        return json.loads((self.checkout / "examples" / f"{name}.json").read_text(encoding="utf-8"))

    @contextlib.contextmanager
    def service(self):
        """A function that gives the document at a path of the service."""
        process = subprocess.Popen([self.binary, "serve", "--port", "0", "--no-log"], cwd=self.folder,
                                   stderr=subprocess.PIPE, text=True)
        try:
            port = int(re.search(r":(\d+)/", process.stderr.readline()).group(1))

            def get(path):
                connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
                connection.request("GET", path)
                return json.loads(connection.getresponse().read())

            yield get
        finally:
            process.terminate()
            process.wait()


@contextlib.contextmanager
def in_a_folder_of_its_own(binary, checkout):
    with tempfile.TemporaryDirectory(prefix="plenum-docs-") as folder:
        yield Program(binary, checkout, folder)
