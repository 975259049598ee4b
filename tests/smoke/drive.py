"""Drives the window of Spline Lab with mouse and keys and checks what it reports.

The program writes one line of JSON to the file in SPLINE_LAB_SMOKE_LOG on every change; each check waits for the line
that it needs, with a deadline, because software rendering is slow. `run.sh` starts the display and this script.
"""

import json
import math
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

DEADLINE = 60.0  # seconds until something that was asked for must have happened
PAUSE = 0.05  # seconds between two looks at the log
DRAG = (60, -40)  # pixels: to the right and up


class Failed(Exception):
    """A check did not hold."""


passed = []


def check(name, holds, detail=""):
    """Counts a check that holds and stops at one that does not."""
    if not holds:
        raise Failed(f"{name}: {detail}" if detail else name)
    passed.append(name)
    print(f"smoke: ok  {name}", flush=True)


def tool(*arguments):
    """Runs a command and returns what it prints."""
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, timeout=DEADLINE)
    if done.returncode != 0:
        raise Failed(f"{' '.join(map(str, arguments))} ended with {done.returncode}: {done.stderr.strip()}")
    return done.stdout.strip()


class Lab:
    """One run of the program."""

    def __init__(self, program, document, folder, run):
        self.log = folder / f"events-{run}.jsonl"
        self.errors = folder / f"program-{run}.log"
        home = folder / "home"
        environment = dict(os.environ, HOME=str(home), SPLINE_LAB_SMOKE_LOG=str(self.log))
        for variable, name in [
            ("XDG_CONFIG_HOME", "config"),
            ("XDG_DATA_HOME", "data"),
            ("XDG_STATE_HOME", "state"),
            ("XDG_CACHE_HOME", "cache"),
            ("XDG_RUNTIME_DIR", "runtime"),
        ]:
            (home / name).mkdir(parents=True, exist_ok=True)
            environment[variable] = str(home / name)
        (home / "runtime").chmod(0o700)
        with open(self.errors, "wb") as errors:
            self.process = subprocess.Popen(
                [program, str(document)], env=environment, cwd=folder, stdout=errors, stderr=errors
            )
        self.window = None

    def events(self):
        """All complete lines of the log."""
        try:
            text = self.log.read_text(encoding="utf-8")
        except FileNotFoundError:
            return []
        complete = text[: text.rfind("\n") + 1]
        return [json.loads(line) for line in complete.splitlines() if line.strip()]

    def state(self):
        """The last line that describes the curve."""
        described = [event for event in self.events() if event.get("world")]
        if not described:
            raise Failed("the program has not described a curve")
        return described[-1]

    def wait(self, what, holds, deadline=DEADLINE):
        """Waits until `holds(events)` and returns its value."""
        end = time.monotonic() + deadline
        while True:
            value = holds(self.events())
            if value:
                return value
            if self.process.poll() is not None:
                raise Failed(f"the program ended with {self.process.returncode} while waiting for {what}")
            if time.monotonic() > end:
                raise Failed(f"waited {deadline:.0f} s for {what}; last line: {(self.events() or ['none'])[-1]}")
            time.sleep(PAUSE)

    def wait_for_state(self, what, holds, deadline=DEADLINE):
        """Waits until the last description satisfies `holds`, and returns it."""

        def last_holds(events):
            described = [event for event in events if event.get("world")]
            return described[-1] if described and holds(described[-1]) else None

        return self.wait(what, last_holds, deadline)

    def wait_until_ready(self):
        """Waits for the first frame, takes the keyboard and returns the first description."""
        self.wait("the first frame", lambda events: any(event["event"] == "ready" for event in events))
        self.window = self.wait("the window", lambda _: self.find_window())
        # There is no window manager: the window gets keys only after this, and starts at the corner of the screen.
        tool("xdotool", "windowmove", self.window, 0, 0)
        tool("xdotool", "windowfocus", "--sync", self.window)
        return self.settled("the curve")

    def settled(self, what):
        """The description once the picture has stood still for half a second."""
        end = time.monotonic() + DEADLINE
        last, since = None, time.monotonic()
        while time.monotonic() < end:
            described = [event for event in self.events() if event.get("points")]
            now = described[-1] if described else None
            if now != last:
                last, since = now, time.monotonic()
            elif now is not None and time.monotonic() - since > 0.5:
                return now
            if self.process.poll() is not None:
                raise Failed(f"the program ended with {self.process.returncode} while waiting for {what}")
            time.sleep(PAUSE)
        raise Failed(f"waited {DEADLINE:.0f} s for {what} to stand still")

    def find_window(self):
        """The largest visible window of the program."""
        found = subprocess.run(
            ["xdotool", "search", "--onlyvisible", "--name", "."], capture_output=True, text=True, timeout=DEADLINE
        ).stdout.split()
        largest, area = None, 100 * 100
        for window in found:
            shape = subprocess.run(
                ["xdotool", "getwindowgeometry", "--shell", window], capture_output=True, text=True, timeout=DEADLINE
            ).stdout
            size = dict(line.split("=", 1) for line in shape.splitlines() if "=" in line)
            this = int(size.get("WIDTH", 0)) * int(size.get("HEIGHT", 0))
            if this > area:
                largest, area = window, this
        return largest

    def key(self, keys):
        """Presses a key."""
        tool("xdotool", "windowfocus", "--sync", self.window)
        tool("xdotool", "key", "--clearmodifiers", keys)

    def move(self, x, y):
        """Moves the pointer to a place of the window."""
        tool("xdotool", "mousemove", "--window", self.window, round(x), round(y))

    def drag(self, start, by):
        """Drags with the left button, in steps as a hand does."""
        x, y = round(start[0]), round(start[1])
        self.move(x, y)
        time.sleep(0.3)
        tool("xdotool", "mousedown", 1)
        steps = 8
        for step in range(1, steps + 1):
            time.sleep(0.05)
            self.move(x + by[0] * step / steps, y + by[1] * step / steps)
        time.sleep(0.2)
        tool("xdotool", "mouseup", 1)

    def double_click(self, place):
        """Clicks twice in one place."""
        self.move(*place)
        time.sleep(0.3)
        tool("xdotool", "click", "--repeat", 2, "--delay", 60, 1)

    def quit(self):
        """Closes the program with its shortcut and returns its exit status."""
        self.key("ctrl+q")
        try:
            return self.process.wait(timeout=DEADLINE)
        except subprocess.TimeoutExpired:
            raise Failed(f"the program still runs {DEADLINE:.0f} s after Ctrl+Q") from None

    def end(self):
        """Ends the program however it stands."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()


def moved(old, new, indices):
    """Whether exactly the points `indices` differ."""
    return len(old) == len(new) and all((old[i] != new[i]) == (i in indices) for i in range(len(old)))


def check_screenshot(name, target):
    """Takes a screenshot and checks that something is drawn on it."""
    tool("import", "-window", "root", target)
    colours, deviation = tool("identify", "-format", "%k %[fx:standard_deviation]", target).split()
    check(
        f"{name} is not blank",
        int(colours) > 200 and float(deviation) > 0.02,
        f"{colours} colours, standard deviation {deviation}",
    )


# Room, file, and what is dragged there by how many pixels.
ROOMS = [
    (
        "Approximation",
        "approximation.spline",
        [("Datum 2 of Wave", (0, -40)), ("Knot 0 of method 2 of Wave", (30, 0))],
    ),
    (
        "Surfaces",
        "surface.spline",
        [("Control point 8 of Torus", DRAG), ("Vertex 6 of Cube", (30, -20))],
    ),
    ("Finite elements", "mushroom.spline", [("Centre of ellipse 3 of Mushroom", DRAG)]),
]


def run(program, start, folder):
    """All checks in order."""
    document = folder / "smoke.spline"
    shutil.copyfile(start, document)
    before_saving = document.read_bytes()

    lab = Lab(program, document, folder, "first")
    try:
        first = lab.wait_until_ready()
        world, screen = first["world"], first["points"]
        check("the window opens with the file", len(world) >= 4 and len(world) == len(screen), f"{first}")
        check_screenshot("the picture after the start", folder / "first.png")

        # Drag control point 1 and bring it back.
        lab.drag(screen[1], DRAG)
        after = lab.wait_for_state("the drag", lambda now: now["world"] != world and now.get("undo"))
        after = lab.settled("the dragged point")
        check("dragging moves control point 1 alone", moved(world, after["world"], [1]), f"{world} became {after['world']}")
        pixels = math.dist(screen[0], screen[-1]) / math.dist(world[0], world[-1])
        way = [(new - old) * pixels for old, new in zip(world[1], after["world"][1])]
        check(
            "it moves as far as the mouse, up being positive",
            abs(way[0] - DRAG[0]) < 6 and abs(way[1] + DRAG[1]) < 6,
            f"{way} pixels instead of {DRAG}",
        )
        lab.key("ctrl+z")
        undone = lab.wait_for_state("Ctrl+Z", lambda now: now["world"] != after["world"])
        check("Ctrl+Z brings back the very same coordinates", undone["world"] == world, f"{undone['world']}")

        # Insert a knot by double click.
        undone = lab.settled("the undone drag")
        inserted = None
        for _ in range(3):
            lab.double_click(undone["curve_at"])
            try:
                inserted = lab.wait_for_state(
                    "a knot by double click", lambda now: len(now["knots"]) != len(undone["knots"]), DEADLINE / 4
                )
                break
            except Failed as failure:
                print(f"smoke: once more: {failure}", flush=True)
        check("a double click on the curve inserts a knot", inserted is not None)
        check("it is one knot", len(inserted["knots"]) == len(undone["knots"]) + 1, f"{inserted['knots']}")
        check("and one control point", len(inserted["world"]) == len(world) + 1, f"{inserted['world']}")

        # Save, close, open again.
        lab.key("ctrl+s")
        lab.wait("saving", lambda events: any(event["event"] == "saved" for event in events))
        check("Ctrl+S changes the file", document.read_bytes() != before_saving)
        status = lab.quit()
        check("Ctrl+Q closes the window", status == 0, f"exit status {status}")
    finally:
        lab.end()

    lab = Lab(program, document, folder, "second")
    try:
        again = lab.wait_until_ready()
        check("the file opens again with the same points", again["world"] == inserted["world"], f"{again['world']}")
        check("and the same knots", again["knots"] == inserted["knots"], f"{again['knots']}")
        check_screenshot("the picture after opening again", folder / "second.png")
        status = lab.quit()
        check("the window closes again", status == 0, f"exit status {status}")
    finally:
        lab.end()


def run_room(program, folder, room, start, drags):
    """The room `room`, opened with the file `start`: each of `drags`, a name and a way, is dragged and undone."""
    document = folder / start.name
    shutil.copyfile(start, document)
    lab = Lab(program, document, folder, start.stem)

    def settled(what, holds=lambda event: True):
        """The last line once its handles have stood still for half a second and it satisfies `holds`."""
        end = time.monotonic() + DEADLINE
        last, since = None, time.monotonic()
        while time.monotonic() < end:
            lines = [event for event in lab.events() if event.get("handles")]
            now = lines[-1] if lines and holds(lines[-1]) else None
            if now != last:
                last, since = now, time.monotonic()
            elif now is not None and time.monotonic() - since > 0.5:
                return now
            time.sleep(PAUSE)
        raise Failed(f"waited {DEADLINE:.0f} s for {what}")

    try:
        lab.wait("the window", lambda events: any(event["event"] == "ready" for event in events))
        lab.window = lab.wait("the window", lambda _: lab.find_window())
        tool("xdotool", "windowmove", lab.window, 0, 0)
        tool("xdotool", "windowfocus", "--sync", lab.window)
        first = settled("the handles")
        check(f"{start.name} opens in {room}", first["room"] == room, f"{first['room']}")
        for name, step in drags:
            before = settled(name)
            lab.drag(before["handles"][name], step)
            after = settled(f"the drag of {name}", lambda event: event["revision"] != before["revision"])
            (x, y), (new_x, new_y) = before["handles"][name], after["handles"][name]
            way = (new_x - x, new_y - y)
            check(f"{name} follows the mouse", math.dist(way, step) < 3, f"{way} instead of {step}")
            lab.key("ctrl+z")
            undone = settled(f"undo of {name}", lambda event: event["redo"] is not None)
            check(f"Ctrl+Z brings {name} back", undone["handles"][name] == [x, y], f"{undone['handles'][name]}")
        check_screenshot(f"the picture of {room}", folder / f"{start.stem}.png")
        status = lab.quit()
        check(f"{room} closes", status == 0, f"exit status {status}")
    finally:
        lab.end()


def main():
    """Runs the checks and says how many passed."""
    program, start, folder = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    failure = None
    try:
        run(program, start, folder)
        for room, file, drags in ROOMS:
            run_room(program, folder, room, start.with_name(file), drags)
    except (Failed, subprocess.TimeoutExpired, KeyError, ValueError) as error:
        failure = f"{type(error).__name__}: {error}"
        print(f"smoke: FAILED  {failure}", flush=True)
        subprocess.run(["import", "-window", "root", folder / "failure.png"], check=False, timeout=DEADLINE)
        for log in sorted(folder.glob("program-*.log")) + sorted(folder.glob("events-*.jsonl")):
            lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
            print(f"--- the end of {log.name}")
            print("\n".join(lines[-20:]), flush=True)
    keep = os.environ.get("SPLINE_LAB_SMOKE_KEEP")
    if keep:
        Path(keep).mkdir(parents=True, exist_ok=True)
        for pattern in ("*.png", "*.log", "*.jsonl", "*.spline"):
            for file in folder.glob(pattern):
                shutil.copy(file, keep)
    print(f"smoke: {len(passed)} passed, {1 if failure else 0} failed")
    return 1 if failure else 0


if __name__ == "__main__":
    sys.exit(main())
