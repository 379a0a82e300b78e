"""A study in a temporary folder with a program that stands in for sphdrop: it writes results of known numbers at once."""

from __future__ import annotations

import sys
from pathlib import Path

COMMIT = "0123456789abcdef0123456789abcdef01234567"

CASE = """name = "toy"
[resolution]
spacing = 2.5e-5
[time]
end = 1e-3
[drop]
velocity = [0.0, -0.5]
"""

RUNS = """[levels.paper]
set = {}
[levels.short]
set = {"time.end" = 5e-4}
runs = ["slow"]
[runs.slow]
set = {}
[runs.fast]
set = {"drop.velocity" = [0, -1.0]}
"""

EXPECTED = """level,quantity,unit,theory,paper,goal,goal_tolerance,ours,tolerance,description
paper,speed_slow,m/s,0.5,,0.5,0.01,0.5,1e-6,"speed at the start, downwards"
paper,speed_fast,m/s,,1.25,,,1.0,1e-6,the same
short,speed_slow,m/s,0.5,,,,0.5,1e-6,speed at the start
"""

# The history of a drop that turns round at half time: everything is known in closed form.
PLOT = """
from comparison.study import Drawing

def measure(results):
    return {f"speed_{name}": -float(run.history["drop_velocity_y"][0]) for name, run in results.items()}

def draw(results, folder):
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(1, 1))
    for run in results.values():
        axes.plot(run.history["time"], run.history["drop_velocity_y"])
    figure.savefig(folder / "speed.png", dpi=30)
    plt.close(figure)
    return [Drawing(folder / "speed.png", "speed over time", "Fig. 99")]
"""

README = """# A toy

What it shows: the drop's speed, `drop_velocity_y`.

| a | b |
|---|---|
| 1 | 2 |
"""

PROGRAM = '''#!{python}
import json, math, os, signal, sys, time
from pathlib import Path

if "--version" in sys.argv:
    print("sphdrop 0.1.0, commit " + os.environ.get("TOY_COMMIT", "{commit}"))
    sys.exit(0)
settings = dict(word.removeprefix("--set=").split("=", 1) for word in sys.argv[2:] if word.startswith("--set="))
if "--print-case" in sys.argv:
    if "bad" in settings:
        sys.exit("toy: bad is not a known key")
    print(Path(sys.argv[1]).read_text())
    sys.exit(0)
output = Path(sys.argv[sys.argv.index("--output") + 1])
with open(os.environ["TOY_LOG"], "a") as log:
    log.write(output.name + " resumed" * ("--restart" in sys.argv) + "\\n")
speed = -json.loads(settings.get("drop.velocity", "[0, -0.5]"))[1]
speed *= 2 if settings.get("mode") == "modern" else 1
end = float(settings.get("time.end", "1e-3"))

information = dict(program="sphdrop", git_commit=os.environ.get("TOY_COMMIT", "{commit}"), status="running", ranks=1)
output.mkdir(parents=True, exist_ok=True)
(output / "run.json").write_text(json.dumps(information))
if output.name in os.environ.get("TOY_FAILS", "").split():
    print("the drop is not a number")
    sys.exit(3)
if output.name in os.environ.get("TOY_STOPS", "").split():
    (output / "checkpoint_000000000025.h5").write_text("")
    sys.exit(5)
if output.name in os.environ.get("TOY_WAITS", "").split():
    (output / "waits").write_text(str(os.getpid()))
    time.sleep(60)

mass = 1000 * math.pi / 4 * 1e-6
columns = ["time [s]", "drop_velocity_y [m/s]", "kinetic_fluid [J/m]", "total [J/m]", "unaccounted [J/m]",
           "dissipated_fluid [J/m]", "momentum_fluid_x [kg/s]", "momentum_fluid_y [kg/s]", "contact_impulse_y [N s/m]"]
rows = [",".join(columns)]
for k in range(11):
    velocity = -speed if k < 5 else 0.5 * speed
    energy = 0.5 * mass * velocity**2
    heat = 0.5 * mass * speed**2 - energy
    values = [end * k / 10, velocity, energy, energy, 0.0, heat, 0.0, mass * velocity, -mass * (velocity + speed)]
    rows.append(",".join(repr(value) for value in values))
(output / "history.csv").write_text("\\n".join(rows) + "\\n")
(output / "case.cfg").write_text("""[fluid]
density = 1000
[drop]
shape = "round"
diameter = 1e-3
[gravity]
acceleration = [0, 0]
""")
information.update(status="completed", wall_time_seconds=2.0, state_hash="00000000deadbeef",
                   details=dict(particles=100, steps=50, simulated_time=end))
(output / "run.json").write_text(json.dumps(information))
'''


def write_program(path: Path) -> Path:
    """The stand-in, executable. TOY_LOG names the file that gets a line for each run; TOY_FAILS, TOY_STOPS and TOY_WAITS
    name runs that end with an error, stop at a checkpoint or go on for a minute."""
    path.write_text(PROGRAM.replace("{python}", sys.executable).replace("{commit}", COMMIT), encoding="utf-8")
    path.chmod(0o755)
    return path


def write_study(folder: Path) -> Path:
    """A study of two runs, slow and fast, of which the level short has the first only."""
    folder.mkdir(parents=True)
    for name, text in (("case.cfg", CASE), ("runs.toml", RUNS), ("expected.csv", EXPECTED), ("plot.py", PLOT), ("README.md", README)):
        (folder / name).write_text(text, encoding="utf-8")
    return folder
