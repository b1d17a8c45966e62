"""The work of .ci/kills: PROGRAM KILLS MEGABYTES PROCESSES SIGNAL."""

import ctypes
import datetime
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

PROGRAM, KILLS, MEGABYTES, PROCESSES, SIGNAL = sys.argv[1], int(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4]), sys.argv[5]
# Nothing older is lost, in seconds. What can still be saved at the end is.
LIMIT = 1.0 if SIGNAL == "KILL" else 0.1
PATIENCE = 120  # for a start, in seconds
STEP = 10  # kelvins per press
BETWEEN = 0.02  # presses, in seconds
SAVES = 7  # presses for each Ctrl+S
WARM = 15000  # kelvins from which the temperature is set back

lock = threading.Lock()
left = KILLS
results = []  # (age of the oldest lost change, temporary files, presses)
faults = []


def fault(words):
    with lock:
        faults.append(words)
        print("FAILED ", words, flush=True)


def until(what, found):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        value = found()
        if value:
            return value
        time.sleep(0.02)
    raise TimeoutError(what)


class Keys:
    """Key presses, without a process for each."""

    def __init__(self, display):
        self.x = ctypes.CDLL("libX11.so.6")
        self.test = ctypes.CDLL("libXtst.so.6")
        self.x.XOpenDisplay.restype = ctypes.c_void_p
        self.x.XStringToKeysym.restype = ctypes.c_ulong
        self.display = ctypes.c_void_p(self.x.XOpenDisplay(display.encode()))

    def code(self, name):
        return self.x.XKeysymToKeycode(self.display, ctypes.c_ulong(self.x.XStringToKeysym(name.encode())))

    def press(self, code):
        for down in (1, 0):
            self.test.XTestFakeKeyEvent(self.display, code, down, ctypes.c_ulong(0))
        self.x.XSync(self.display, 0)

    def save(self):
        control, key = self.code("Control_L"), self.code("s")
        for code, down in ((control, 1), (key, 1), (key, 0), (control, 0)):
            self.test.XTestFakeKeyEvent(self.display, code, down, ctypes.c_ulong(0))
        self.x.XSync(self.display, 0)

    def close(self):
        self.x.XCloseDisplay(self.display)


class Worker:
    def __init__(self, number):
        self.number = number
        self.work = tempfile.mkdtemp(prefix="kills-")
        self.profile = os.path.join(self.work, "data", "chromascope")
        self.document = os.path.join(self.profile, "document.json")
        self.xvfb = None
        self.sets = 0
        folder = os.path.join(self.work, "session")
        os.mkdir(folder)
        self.session = os.path.join(folder, "session.chromascope")
        with open(self.session, "w", encoding="utf-8") as session:
            json.dump({"format": "chromascope", "version": 4}, session)

    def screen(self):
        name = os.path.join(self.work, "display")
        with open(name, "wb") as display:
            command = ["Xvfb", "-displayfd", "1", "-screen", "0", "1280x800x24", "-nolisten", "tcp"]
            self.xvfb = subprocess.Popen(command, stdout=display, stderr=subprocess.DEVNULL)
        until("Xvfb", lambda: open(name).read().strip())
        self.display = ":" + open(name).read().strip()
        self.environment = dict(
            PATH=os.environ["PATH"], DISPLAY=self.display, HOME=self.work, LIBGL_ALWAYS_SOFTWARE="1", LC_ALL="C.UTF-8",
            XDG_DATA_HOME=os.path.join(self.work, "data"), XDG_RUNTIME_DIR=self.work, RUST_LOG="chromascope=info,chromascope::files=debug",
        )

    def start(self, *arguments):
        self.log = os.path.join(self.work, "log")
        with open(self.log, "wb") as log:
            self.process = subprocess.Popen([PROGRAM, *arguments], env=self.environment, stdout=log, stderr=log)
        until("the first frame", lambda: "first frame" in open(self.log).read() or self.process.poll() is not None)
        if self.process.poll() is not None:
            raise RuntimeError("ended by itself: " + open(self.log).read())

    def of_session(self):
        """Temperature in the session's file, which is whole at any time."""
        try:
            with open(self.session, encoding="utf-8") as session:
                return json.load(session).get("temperature_k", 0.0)
        except FileNotFoundError:
            return 0.0

    def read(self):
        with open(self.document, encoding="utf-8") as document:
            return json.load(document)

    def check(self, document):
        """The document is whole: all sets, and their curves."""
        if len(document["own"]) != self.sets:
            fault(f"{len(document['own'])} sets of {self.sets}")
        for name in {own["curves_in"][0] for own in document["own"]}:
            with open(os.path.join(self.profile, "curves", name), encoding="utf-8") as curves:
                lists = json.load(curves)
            if any(own["curves_in"][1] >= len(lists) for own in document["own"] if own["curves_in"][0] == name):
                fault(f"{name} lacks a list")

    def temporary(self):
        return [name for _, _, files in os.walk(self.profile) for name in files if name.startswith(".chromascope-")]

    def fill(self):
        """Two files of curves: several sets that are opened at once leave light and chart as they are."""
        paths = []
        for name in ("first", "second"):
            rows = int(MEGABYTES * 1e6 / 2 / 100 / 9)
            path = os.path.join(self.work, name + ".csv")
            with open(path, "w") as table:
                table.write("wavelength (nm)," + ",".join(f"{name} {i}" for i in range(100)) + "\n")
                for row in range(rows):
                    values = ",".join(f"{random.random():.6f}" for _ in range(100))
                    table.write(f"{300 + 1000 * row / rows:.4f},{values}\n")
            paths.append(path)
        self.start(*paths)
        until("the sets", lambda: os.path.exists(self.document) and len(self.read()["own"]) == 2)
        self.sets = 2
        self.process.kill()
        self.process.wait()
        for path in paths:
            os.remove(path)

    def focus(self):
        search = ["xdotool", "search", "--onlyvisible", "--name", "Chromascope"]
        run = lambda: subprocess.run(search, env=self.environment, capture_output=True, text=True).stdout.split()
        window = until("the window", run)[0]
        subprocess.run(["xdotool", "windowfocus", "--sync", window], env=self.environment, check=True)

    def once(self):
        if self.xvfb.poll() is not None:
            self.screen()
        if os.path.exists(self.document):
            document = self.read()
            if document["temperature_k"] > WARM:
                document["temperature_k"] = 1000.0
                with open(self.document, "w", encoding="utf-8") as file:
                    json.dump(document, file)
        before = time.monotonic()
        # The first time it is opened, then it is known; it is written anew each time.
        if os.path.exists(self.document) and "session" in self.read():
            if os.path.exists(self.session):
                os.remove(self.session)
            self.start()
        else:
            self.start(self.session)
            until("the session", lambda: os.path.exists(self.document) and "session" in self.read())
        started = time.monotonic() - before
        if self.temporary():
            fault(f"after the start {self.temporary()} is left")
        odd = [name for name in os.listdir(self.profile) if name.startswith("document-")]
        if odd or "could not be read" in open(self.log).read():
            fault(f"not read at the start: {odd}")
        self.focus()
        # Later than what comes from the window's start, which takes the keyboard from the field.
        time.sleep(2.5)
        keys = Keys(self.display)
        up = keys.code("Up")
        now = lambda: self.read()["temperature_k"] if os.path.exists(self.document) else None
        keys.press(keys.code("t"))
        time.sleep(1.0)
        base, presses, saved = now(), [], 0.0
        end = time.monotonic() + random.uniform(0.3, 4.0)
        while time.monotonic() < end:
            keys.press(up)
            presses.append(time.time())
            if len(presses) % SAVES == 0:
                keys.save()
            saved = self.of_session()
            time.sleep(BETWEEN)
        ended = self.end(keys)
        document = self.read()
        if document["session"]["path"] != self.session:
            fault("the document does not name its session")
        if self.of_session() < saved:
            fault(f"the session's file went back from {saved} K to {self.of_session()} K")
        self.check(document)
        kept = document["temperature_k"]
        lost = [made for kelvin, made in self.changes() if kelvin > kept and made < ended]
        age = ended - lost[0] if lost else 0.0
        if age > LIMIT:
            fault(f"of {len(presses)} changes some are lost, the oldest {age:.2f} s before the end")
        count = round((kept - base) / STEP)
        pressed = max(0.0, ended - presses[count]) if count < len(presses) else 0.0
        with lock:
            results.append((age, len(self.temporary()), len(presses), pressed))
            print(f"{len(results):4}  start {started:.1f} s, {len(presses)} presses; the oldest change lost was made "
                  f"{age * 1000:.0f} ms before the end, its key pressed {pressed * 1000:.0f} ms before", flush=True)

    def changes(self):
        """Temperatures that the program took in, with the time."""
        for line in open(self.log, encoding="utf-8"):
            head, found, kelvin = line.strip().partition("] changed: ")
            if found:
                made = datetime.datetime.fromisoformat(head[1:].split(" ")[0].replace("Z", "+00:00"))
                yield float(kelvin.removesuffix(" K")), made.timestamp()

    def end(self, keys):
        """Ends the process as was asked for; the time at which it was."""
        if SIGNAL == "X":
            keys.close()
            ended = time.time()
            self.xvfb.kill()
            self.xvfb.wait()
            code = self.process.wait(PATIENCE)
            if code != 1:
                fault(f"without a display it ends with {code}")
            return ended
        number = getattr(signal, "SIG" + SIGNAL)
        ended = time.time()
        self.process.send_signal(number)
        code = self.process.wait(PATIENCE)
        keys.close()
        if code != -number:
            fault(f"SIG{SIGNAL} ends it with {code}")
        return ended

    def run(self):
        global left
        try:
            self.screen()
            if MEGABYTES > 0:
                self.fill()
            while True:
                with lock:
                    if left == 0:
                        break
                    left -= 1
                self.once()
        except Exception as error:
            fault(f"process {self.number}: {error!r}")
        finally:
            for process in (getattr(self, "process", None), self.xvfb):
                if process is not None and process.poll() is None:
                    process.kill()
                    process.wait()
            shutil.rmtree(self.work, ignore_errors=True)


threads = [threading.Thread(target=Worker(number).run) for number in range(PROCESSES)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
ages = sorted(age for age, _, _, _ in results) or [0.0]
pressed = max((pressed for _, _, _, pressed in results), default=0.0)
print(f"kills: {len(results)} of {KILLS} by {SIGNAL}, {MEGABYTES:g} MB, {sum(n for _, _, n, _ in results)} key presses; the oldest "
      f"change lost was made {ages[-1] * 1000:.0f} ms before the end (median {ages[len(ages) // 2] * 1000:.0f} ms; from the "
      f"key press on {pressed * 1000:.0f} ms); {sum(count for _, count, _, _ in results)} temporary files after kills, none "
      f"after the next start unless said; {len(faults)} faults")
sys.exit(1 if faults or len(results) < KILLS else 0)
