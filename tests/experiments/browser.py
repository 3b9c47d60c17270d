# SPDX-License-Identifier: BSD-3-Clause
"""A browser without a window and without a network, driven by the DevTools protocol through a pipe."""
import base64
import fcntl
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
PATIENCE = 90  # s, for any answer: a software renderer on a loaded machine is slow
FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--host-resolver-rules=MAP * ~NOTFOUND", "--proxy-server=127.0.0.1:9", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--no-first-run", "--hide-scrollbars", "--force-color-profile=srgb",
         "--remote-debugging-pipe"]


class Browser:
    """Use as a context: one tab, whose errors and requests are collected."""

    def __init__(self):
        self.errors, self.requests = [], []
        self._next, self._rest, self._answers = 0, b"", {}

    def __enter__(self):
        self._home = tempfile.TemporaryDirectory(prefix="polhode_browser_", ignore_cleanup_errors=True)
        to_browser, self._out = os.pipe()
        self._in, from_browser = os.pipe()
        # Far from 3 and 4, from which the browser reads and to which it writes.
        ends = [fcntl.fcntl(fd, fcntl.F_DUPFD_CLOEXEC, 20) for fd in (to_browser, from_browser)]

        def place_ends():
            for end, place in zip(ends, (3, 4)):
                os.dup2(end, place)

        self._process = subprocess.Popen([PROGRAM, *FLAGS, f"--user-data-dir={self._home.name}", "about:blank"],
                                         pass_fds=(3, 4), preexec_fn=place_ends, stdin=subprocess.DEVNULL,
                                         stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for fd in (to_browser, from_browser, *ends):
            os.close(fd)
        target = self._send("Target.createTarget", {"url": "about:blank"})["targetId"]
        self._session = self._send("Target.attachToTarget", {"targetId": target, "flatten": True})["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.do(f"{domain}.enable")
        return self

    def __exit__(self, *_):
        self._process.kill()
        self._process.wait()
        os.close(self._out)
        os.close(self._in)
        self._home.cleanup()

    def do(self, method, **parameters):
        return self._send(method, parameters, self._session)

    def run(self, script):
        """The value of an expression in the page; a promise is waited for."""
        answer = self.do("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise AssertionError(f"{script}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def open(self, path, width=1280, height=720, dark=False, ready="!!window.replay", media=""):
        """Opens a file and waits until it is ready and has drawn two frames. media: "print" for the page on paper."""
        self.do("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.do("Emulation.setEmulatedMedia", media=media,
                features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.do("Page.navigate", url=path.resolve().as_uri())
        self.wait_for(f"document.readyState === 'complete' && location.href !== 'about:blank' && {ready}")
        self.frames(2)

    def frames(self, count):
        self.run(f"new Promise((done) => {{ let n = {count}; const next = () => n-- ? requestAnimationFrame(next) : done(); next(); }})")

    def wait_for(self, condition):
        end = time.monotonic() + PATIENCE
        while not self.run(condition):
            if time.monotonic() > end:
                raise AssertionError(f"not so after {PATIENCE} s: {condition}; {self.errors}")
            time.sleep(0.05)

    def key(self, key, **more):
        for kind in ("keyDown", "keyUp"):
            self.do("Input.dispatchKeyEvent", type=kind, key=key, **more)

    def picture(self, path):
        """A PNG of the window."""
        path.write_bytes(base64.b64decode(self.do("Page.captureScreenshot", format="png")["data"]))

    def _send(self, method, parameters, session=None):
        self._next += 1
        message = {"id": self._next, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        text = json.dumps(message).encode() + b"\0"
        while text:
            text = text[os.write(self._out, text):]
        number = self._next
        end = time.monotonic() + PATIENCE
        while number not in self._answers:
            self._read(end, method)
        answer = self._answers.pop(number)
        if "error" in answer:
            raise AssertionError(f"{method}: {answer['error']}")
        return answer["result"]

    def _read(self, end, method):
        ready, _, _ = select.select([self._in], [], [], max(0, end - time.monotonic()))
        chunk = os.read(self._in, 1 << 20) if ready else b""
        if not chunk:
            raise AssertionError(f"the browser gives no answer to {method} ({'it ended' if ready else 'too late'})")
        *whole, self._rest = (self._rest + chunk).split(b"\0")
        for text in whole:
            message = json.loads(text)
            if "id" in message:
                self._answers[message["id"]] = message
            else:
                self._note(message["method"], message.get("params", {}))

    def _note(self, event, parameters):
        if event == "Runtime.exceptionThrown":
            self.errors.append(str(parameters["exceptionDetails"]))
        elif event == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning", "assert"):
            self.errors.append(str(parameters["args"]))
        elif event == "Log.entryAdded" and parameters["entry"]["level"] in ("error", "warning"):
            self.errors.append(parameters["entry"]["text"])
        elif event == "Network.requestWillBeSent":
            self.requests.append(parameters["request"]["url"])
