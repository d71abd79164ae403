"""What the server of the studio lets in, and what it does not. Usage: studio_server.py PELAGE FOLDER

FOLDER is for a page of its own and is made. Exits 1 where anything is not as it should be.
"""
import concurrent.futures
import http.client
import json
import os
import re
import signal
import socket
import struct
import subprocess
import sys

failures = 0


def expect(what, found, wanted):
    global failures
    if found != wanted:
        failures += 1
        print(f"FAILED: {what}: {found!r} instead of {wanted!r}")


class Studio:
    """A running `pelage studio`."""

    def __init__(self, program, page, *options):
        self.process = subprocess.Popen([program, "studio", "--no-open", "--page", page, *options], text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        line = self.process.stdout.readline()
        match = re.search(r"http://127\.0\.0\.1:(\d+)/#token=([0-9a-f]{32})$", line.strip())
        if not match:
            sys.exit(f"no link: {line!r} {self.process.stderr.read()!r}")
        self.port, self.token = int(match[1]), match[2]

    def request(self, method, path, body=None, **headers):
        """Status and body; a header of None is left out."""
        headers = {key.replace("_", "-"): value for key, value in headers.items()}
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.putrequest(method, path, skip_host="Host" in headers)
        if body is not None:
            headers["Content-Length"] = str(len(body))
        for key, value in headers.items():
            connection.putheader(key, value)
        connection.endheaders(body)
        response = connection.getresponse()
        return response.status, response.read()

    def ask(self, what, **request):
        text = json.dumps({"do": what, **request}).encode()
        status, reply = self.request("POST", "/api", struct.pack("<I", len(text)) + text, X_Pelage_Token=self.token)
        length = struct.unpack("<I", reply[:4])[0] if status == 200 else 0
        return json.loads(reply[4:4 + length]) if status == 200 else status

    def raw(self, text, more=b""):
        """The first line of the reply to bytes as they are; what the server no longer reads does not matter."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=60) as connection:
            connection.sendall(text.encode())
            try:
                for _ in range(64):
                    connection.sendall(more)
            except OSError:
                pass
            try:
                return connection.recv(4096).split(b"\r\n")[0].decode()
            except OSError:
                return ""

    def lives(self, after):
        expect(f"after {after}", self.ask("hello")["engine"], "native")


def check_page(studio, page):
    expect("page", studio.request("GET", "/"), (200, b"<p>page</p>"))
    expect("script", studio.request("GET", "/part/script.js"), (200, b"1;"))
    for path in ("/../secret", "/part/../../secret", "/%2e%2e/secret", "//etc/passwd", "/part/..%2f..%2fsecret",
                 "/index.html/", "/part"):
        expect(path, studio.request("GET", path)[0], 404)
    # A link out of the folder that came later: the page is what it was when the program began.
    os.symlink("/etc/hostname", os.path.join(page, "later"))
    expect("later", studio.request("GET", "/later")[0], 404)


def check_strangers(studio):
    own = f"127.0.0.1:{studio.port}"
    token = {"X_Pelage_Token": studio.token}
    for path in ("/", "/api"):
        method = "GET" if path == "/" else "POST"
        expect(f"other host, {path}", studio.request(method, path, b"", Host="evil.example", **token)[0], 403)
        expect(f"other port, {path}", studio.request(method, path, b"", Host="127.0.0.1:1", **token)[0], 403)
        expect(f"other origin, {path}", studio.request(method, path, b"", Origin="http://evil.example", **token)[0], 403)
        expect(f"no origin's name, {path}", studio.request(method, path, b"", Origin="null", **token)[0], 403)
    expect("own origin", studio.request("POST", "/api", b"", Origin=f"http://{own}", **token)[0], 200)
    for wrong in ("", "0" * 32, studio.token[:-1], studio.token + "0"):
        for path in ("/api", "/stop"):
            expect(f"token {wrong!r}, {path}", studio.request("POST", path, b"", X_Pelage_Token=wrong)[0], 403)
    expect("no token", studio.request("POST", "/api", b"")[0], 403)
    expect("another method", studio.request("PUT", "/api", b"", **token)[0], 404)


def check_amounts(studio):
    head = f"POST /api HTTP/1.1\r\nHost: 127.0.0.1:{studio.port}\r\nX-Pelage-Token: {studio.token}\r\n"
    first = studio.raw(head + f"Content-Length: {2 << 30}\r\n\r\n", b"x" * 65536)
    expect("2 GiB", first in ("", "HTTP/1.1 413 Payload Too Large"), True)
    studio.lives("2 GiB")
    studio.raw("GET / HTTP/1.1\r\n" + "A: b\r\n" * 20000)
    studio.raw("\x00\x01garbage\r\n\r\n")
    studio.lives("garbage")
    for at_once in (8, 100):
        with concurrent.futures.ThreadPoolExecutor(at_once) as pool:
            replies = list(pool.map(lambda _: ask_or_none(studio), range(500)))
        expect(f"{at_once} at once: wrong answers", sum(r is not None and not r["ok"] for r in replies), 0)
        if at_once == 8:  # more than a browser opens
            expect("8 at once: answers", sum(r is not None for r in replies), 500)
    studio.lives("1,000 requests")


def ask_or_none(studio):
    """More connections than the system lets wait may be refused."""
    try:
        return studio.ask("hello")
    except OSError:
        return None


def check_killed_page(studio):
    """A page that goes away in the middle of a request."""
    studio.ask("shape", name="builtin:sphere?n=642")
    studio.ask("begin", recipe="[[stage]]\nmodel = \"turing\"\nsize = 0.3\n")
    text = b'{"do": "advance", "milliseconds": 300}'
    body = struct.pack("<I", len(text)) + text
    head = (f"POST /api HTTP/1.1\r\nHost: 127.0.0.1:{studio.port}\r\nX-Pelage-Token: {studio.token}\r\n"
            f"Content-Length: {len(body)}\r\n\r\n").encode()
    for _ in range(5):
        with socket.create_connection(("127.0.0.1", studio.port)) as connection:
            connection.sendall(head + body)
    studio.lives("pages that went away")
    expect("it grows on", studio.ask("advance", steps=1)["ok"], True)


def check_stop(studio):
    """A slice of ten seconds ends at once when it is asked to."""
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        slice_ = pool.submit(studio.ask, "advance", milliseconds=10000, steps=10**9)
        while not slice_.done():
            expect("stop", studio.request("POST", "/stop", b"", X_Pelage_Token=studio.token)[0], 200)
    expect("stopped", slice_.result()["ok"], True)


def main(program, folder):
    page = os.path.join(folder, "page")
    os.makedirs(os.path.join(page, "part"))
    for name, text in (("page/index.html", "<p>page</p>"), ("page/part/script.js", "1;"), ("secret", "secret")):
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)
    studio = Studio(program, page)
    try:
        check_page(studio, page)
        check_strangers(studio)
        check_amounts(studio)
        check_killed_page(studio)
        check_stop(studio)
        taken = subprocess.run([program, "studio", "--no-open", "--page", page, "--port", str(studio.port)], text=True,
                               capture_output=True)
        expect("a port that is taken", (taken.returncode, "cannot be used" in taken.stderr), (5, True))
    finally:
        studio.process.send_signal(signal.SIGINT)
        expect("exit code after Ctrl-C", studio.process.wait(20), 0)
    none = subprocess.run([program, "studio", "--page", os.path.join(folder, "none")], text=True, capture_output=True)
    expect("without a page", (none.returncode, "there is no page" in none.stderr), (3, True))


main(*sys.argv[1:])
print("the studio lets in whom it should" if failures == 0 else f"{failures} failures")
sys.exit(failures > 0)
