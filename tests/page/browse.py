# SPDX-License-Identifier: Apache-2.0
"""browse.py PAGE PROBE CHECKS: opens PAGE in headless Chromium, first as it is, then a copy of it in which the
scripts PROBE (before all others) and CHECKS (after them) run too. Fails if a check does, if anything is said on
the console, or if anything is asked of the network. Exits 77 (skipped) without Chromium, unless
SPA_REQUIRE_CHROMIUM is set."""

import base64
import hashlib
import html
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import threading

VIRTUAL_MILLISECONDS = 60_000  # for scripts that wait; they pass as fast as the page works


class Listener:
    """A port that counts who connects to it."""

    def __init__(self):
        self.count = 0
        self.socket = socket.create_server(("127.0.0.1", 0))
        self.address = "http://127.0.0.1:%d/" % self.socket.getsockname()[1]
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self):
        while True:
            connection, _ = self.socket.accept()
            self.count += 1
            connection.close()


def browse(chromium, page, *options):
    """The page's DOM as text after its scripts have come to rest, and what was said on the console."""
    with tempfile.TemporaryDirectory(prefix="spa-page-") as profile:
        command = [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                   "--no-first-run", "--disable-background-networking", "--disable-component-update",
                   "--user-data-dir=" + profile, "--window-size=1400,1000", "--enable-logging=stderr",
                   "--virtual-time-budget=%d" % VIRTUAL_MILLISECONDS, *options, "--dump-dom", page.as_uri()]
        done = subprocess.run(command, capture_output=True, timeout=240, check=False)
    console = [line for line in done.stderr.decode(errors="replace").splitlines() if ":CONSOLE" in line]
    return done.stdout.decode(errors="replace"), console


def with_scripts(text, probe, checks):
    """The page with two scripts more, which its Content-Security-Policy lets run."""
    # In strings of a script these are the same, and to the HTML around it nothing.
    probe, checks = (script.replace("</", "<\\/").replace("<!--", "<\\!--") for script in (probe, checks))
    hashes = ["'sha256-%s'" % base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
              for script in (probe, checks)]
    text, count = re.subn("script-src ", lambda match: match[0] + " ".join(hashes) + " ", text, count=1)
    assert count == 1, "the page has no script-src"
    head, tail = text.index("<title>"), text.rindex("</body>")
    return (text[:head] + "<script>" + probe + "</script>" + text[head:tail] + "<script>" + checks + "</script>" +
            text[tail:])


def main():
    page, probe, checks = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    chromium = shutil.which("chromium")
    if chromium is None:
        required = "SPA_REQUIRE_CHROMIUM" in os.environ
        print("failed" if required else "skipped", "chromium is not installed", sep=": ")
        return 1 if required else 77

    problems = []
    dom, console = browse(chromium, page)
    problems += ["on the console of the page as it is: " + line for line in console]
    if "<tbody" not in dom:
        problems.append("the page as it is has no rows")

    listener = Listener()
    copy = page.with_name(page.stem + "_checked.html")
    copy.write_text(with_scripts(page.read_text("utf-8"), probe.read_text("utf-8"),
                                 checks.read_text("utf-8").replace("ADDRESS", listener.address)), "utf-8")
    dom, console = browse(chromium, copy)
    found = re.search('<pre id="findings">(.*?)</pre>', dom, re.DOTALL)
    if found is None:
        problems += ["the checks did not come to their end"] + console
    else:
        findings = json.loads(html.unescape(found[1]))
        print("%s: %d checks" % (page.name, findings["checks"]))
        problems += findings["failures"]
        if findings["checks"] == 0:
            problems.append("nothing was checked")
    if listener.count > 0:
        problems.append("the network was asked %d times" % listener.count)
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
