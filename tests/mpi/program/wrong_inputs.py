"""Wrong inputs: a good case and what is done to it. wrong_messages.py asks the program what it says of each."""

from __future__ import annotations

from dataclasses import dataclass

GOOD = """name = "impact"
[resolution]
spacing = 0.0625e-3
[time]
end = 20e-6
sound_cfl = 0.2
[drop]
diameter = 0.6e-3
velocity = [0, -2]
gap = 2e-6
[solid]
kind = "cantilever"
length = 2e-3
"""


@dataclass(frozen=True)
class Wrong:
    what: str
    edit: tuple[str, str] | None = None  # in the good case: this, by that
    text: str | None = None  # the whole case instead
    words: tuple[str, ...] = ()  # behind the case's name
    line: tuple[str, ...] | None = None  # the whole command line instead
    prepare: str = ""  # what Prepared does to the folder before
    drop: tuple[str, str] | None = None  # in the good file of particles: this, by that


def edited(what: str, old: str, new: str) -> Wrong:
    return Wrong(what, edit=(old, new))


def with_set(what: str, *values: str) -> Wrong:
    return Wrong(what, words=tuple(word for value in values for word in ("--set", value)))


def good_drop() -> str:
    """The same drop as a file of particles: lines 2 to 73."""
    places = [((i - 4.5) * 0.0625, (j - 4.5) * 0.0625) for i in range(10) for j in range(10)]
    return "x [mm],y [mm]\n" + "".join(f"{x},{y}\n" for x, y in places if x * x + y * y < 0.3**2)


GOOD_DROP = good_drop()
OF_FILE = GOOD.replace("diameter = 0.6e-3", 'particles_file = "drop.csv"')


def in_drop(what: str, old: str, new: str) -> Wrong:
    return Wrong(what, text=OF_FILE, drop=(old, new))


def beside_drop(what: str, *values: str) -> Wrong:
    return Wrong(what, text=OF_FILE, words=with_set("", *values).words, drop=("", ""))


CASE_FILE = (
    Wrong("an empty file", text=""),
    Wrong("a binary file", text="\x7fELF\x02\x01"),
    edited("two equal signs", "end = 20e-6", "end = = 20e-6"),
    edited("no equal sign", "end = 20e-6", "end 20e-6"),
    edited("no value", "end = 20e-6", "end ="),
    edited("a word without quotes", '"cantilever"', "cantilever"),
    edited("a quote left open", '"cantilever"', '"cantilever'),
    edited("a bracket left open", "[drop]", "[drop"),
    edited("a unit without quotes", "length = 2e-3", "length = 2 mm"),
    edited("a decimal comma", "length = 2e-3", "length = 0,002"),
    edited("no digit before the point", "-2]", "-.5]"),
    edited("a key given twice", "gap = 2e-6", "gap = 2e-6\ngap = 3e-6"),
    edited("a section given twice", "gap = 2e-6", "gap = 2e-6\n[time]"),
    edited("a misspelt key", "diameter", "diametre"),
    edited("a key in another section", "gap = 2e-6", "gap = 2e-6\nyoungs_modulus = 3e8"),
    edited("a key that several sections have, in none of them", "gap = 2e-6", "gap = 2e-6\n[output]\ndensity = 1000"),
    edited("a misspelt section", "[drop]", "[drops]"),
    edited("a number in quotes", "length = 2e-3", 'length = "2e-3"'),
    edited("a unit that is none", "length = 2e-3", 'length = "2 mmm"'),
    edited("a unit of another kind", "length = 2e-3", 'length = "2 ms"'),
    edited("a word for a number", "length = 2e-3", 'length = "long"'),
    edited("a number for a vector", "velocity = [0, -2]", "velocity = -2"),
    edited("a vector of three", "velocity = [0, -2]", "velocity = [0, -2, 0]"),
    edited("a misspelt word", '"cantilever"', '"cantilver"'),
    edited("a point in an integer", "length = 2e-3", "length = 2e-3\nclamp_layers = 3.5"),
    edited("a negative length", "length = 2e-3", "length = -2e-3"),
    edited("not a number", "length = 2e-3", "length = nan"),
    edited("Poisson's ratio of a half", "length = 2e-3", "length = 2e-3\npoisson_ratio = 0.5"),
    edited("no end", "end = 20e-6\n", ""),
    edited("no length", "length = 2e-3\n", ""),
    edited("a thickness that is no whole number of spacings", "0.0625e-3", "0.06e-3"),
    edited("a length that is no whole number of spacings", "length = 2e-3", "length = 2.01e-3"),
    edited("a drop of three particles", "0.6e-3", "0.2e-3"),
    edited("a time step that is too long", "sound_cfl = 0.2", "step = 1e-6"),
    edited("a spacing of nanometres", "0.0625e-3", "0.0625e-9"),
    Wrong("nothing that moves", text=GOOD.replace("velocity = [0, -2]", 'shape = "none"').replace("cantilever", "none").replace("gap = 2e-6\n", "")),
    edited("a spin of a liquid", "gap = 2e-6", "gap = 2e-6\ninitial_spin = 5"),
    edited("a liquid drop's density in its own section", "gap = 2e-6", "gap = 2e-6\ndensity = 1200"),
    edited("a clamp thinner than the kernel", "length = 2e-3", "length = 2e-3\nclamp_layers = 1"),
    Wrong("several mistakes", text=GOOD.replace("diameter", "diametre").replace("2e-3\n", "2 mm\n").replace("20e-6", "-1")),
    Wrong("several mistakes that the reader can go on from", text=GOOD.replace("diameter", "diametre").replace("20e-6", "-1")),
)

COMMAND_LINE = (
    Wrong("no case", line=()),
    Wrong("a misspelt option", words=("--chekc",)),
    Wrong("two cases", words=("other.cfg",)),
    Wrong("--set without an equal sign", words=("--set", "drop.diameter")),
    Wrong("--set without a value", words=("--set", "drop.diameter=")),
    with_set("--set of a misspelt key", "drop.diametre=1e-3"),
    with_set("--set of a misspelt section", "dorp.diameter=1e-3"),
    with_set("--set of a wrong value", "drop.diameter=-1 mm"),
    with_set("--set of a drop that is not there", "drop[3].diameter=1 mm"),
    with_set("--set against the file", "solid.kind=rigid_wall", "solid.initial_tip_velocity=0.1"),
    Wrong("--until what", words=("--until", "soon")),
    Wrong("--max-walltime what", words=("--max-walltime", "2h")),
    Wrong("--output nowhere", words=("--output", "")),
    Wrong("--restart and --fresh", words=("--restart", "latest", "--fresh")),
)

FILES = (
    Wrong("a case that is not there", line=("impcat.cfg",)),
    Wrong("a folder for a case", line=("folder",), prepare="folder"),
    Wrong("results into a file", words=("--output", "notes.txt"), prepare="file"),
    Wrong("results below a file", words=("--output", "notes.txt/out"), prepare="file"),
    Wrong("results over the case", line=("case.cfg", "--output", "."), prepare="own case"),
    Wrong("a folder that another run writes into", words=("--output", "busy"), prepare="busy"),
    Wrong("a folder with an unfinished run", words=("--output", "unfinished"), prepare="unfinished"),
)

RESTART = (
    Wrong("no checkpoint", words=("--restart", "latest", "--output", "empty")),
    Wrong("a checkpoint that is not there", words=("--restart", "none.h5")),
    Wrong("a file that is none", words=("--restart", "notes.txt"), prepare="file"),
    Wrong("a word that is none", words=("--restart", "newest")),
    Wrong("a checkpoint cut short", words=("--restart", "latest", "--output", "unfinished"), prepare="cut short"),
    Wrong("a checkpoint with a changed byte", words=("--restart", "latest", "--output", "unfinished"), prepare="changed"),
    Wrong("another drop", words=("--restart", "latest", "--output", "unfinished", "--set", "drop.diameter=0.7 mm"), prepare="unfinished"),
    Wrong("another spacing", words=("--restart", "latest", "--output", "unfinished", "--set", "resolution.spacing=31.25 um"), prepare="unfinished"),
)

SET_UP = (
    with_set("the drop on the clamp", "drop.centre_x=0"),
    with_set("the drop in the beam", "drop.placement=centre", "drop.centre_x=1.5 mm", "drop.centre_y=0.2 mm"),
    Wrong("drops that overlap", text=GOOD.replace("[drop]", "[[drop]]").replace(
        "[solid]", '[[drop]]\ndiameter = 0.6e-3\nplacement = "centre"\ncentre_x = 1.6e-3\ncentre_y = 0.7e-3\n[solid]')),
    with_set("too fast for the limit", "safety.speed_limit=1.9"),
    with_set("too little room to fly", "safety.domain_margin=1 um", "solid.kind=none", "solid.length=auto", "drop.gap=0"),
    with_set("springs too soft for the impact", "contact.stiffness_form=fixed", "contact.stiffness=1e-5", "drop.velocity=[0, -4]"),
)

PARTICLES = (
    Wrong("a file of particles that is not there", text=OF_FILE),
    beside_drop("a folder for one", "drop.particles_file=."),
    beside_drop("the case itself for one", "drop.particles_file=impact.cfg"),
    in_drop("nothing in it", GOOD_DROP, ""),
    in_drop("no particles in it", GOOD_DROP, "x,y\n"),
    in_drop("no names of columns", "x [mm],y [mm]\n", ""),
    in_drop("semicolons", "x [mm],y [mm]", "x [mm];y [mm]"),
    in_drop("a column that is none", "x [mm],y [mm]", "x [mm],z [mm]"),
    in_drop("a column too few", "x [mm],y [mm]", "x [mm]"),
    in_drop("milliseconds for a length", "x [mm],y [mm]", "x [ms],y [mm]"),
    in_drop("no unit, and millimetres", "x [mm],y [mm]", "x,y"),
    in_drop("one component of the velocity", GOOD_DROP, "x,y,vx\n0,0,1\n"),
    in_drop("a value too many", "-0.15625,-0.21875\n", "-0.15625,-0.21875,0\n"),
    in_drop("a word for a number", "-0.15625,-0.21875\n", "-0.15625,low\n"),
    in_drop("not a number", "-0.15625,-0.21875\n", "nan,-0.21875\n"),
    in_drop("a number left out", "-0.15625,-0.21875\n", ",-0.21875\n"),
    in_drop("metres for millimetres", "-0.15625,-0.21875\n", "-156250000,-0.21875\n"),
    in_drop("a particle twice", "-0.15625,-0.21875\n", "-0.15625,-0.21875\n-0.15625,-0.21875\n"),
    in_drop("a mass of nothing", GOOD_DROP, "x,y,mass\n0,0,0\n"),
    in_drop("masses of another depth", GOOD_DROP,
            "x,y,mass\n" + "".join(f"{i * 0.0625e-3},{j * 0.0625e-3},1e-9\n" for i in range(9) for j in range(9))),
    beside_drop("another spacing", "resolution.spacing=31.25 um"),
    beside_drop("a diameter that is another's", "drop.diameter=0.9 mm"),
    beside_drop("another shape", "drop.shape=round"),
    beside_drop("a place and the file's place", "drop.placement=file", "drop.centre_x=1 mm"),
    beside_drop("in the beam", "drop.placement=file", "drop.gap=auto"),
    beside_drop("the checksum of another file", "drop.particles_checksum=0123"),
    with_set("particles without a file", "drop.shape=particles"),
)

DOUBTS = (
    in_drop("particles in two pieces", "-0.15625,-0.21875\n", "-0.15625,-0.21875\n2,2\n"),
    with_set("an odd number of rows", "resolution.spacing=0.05 mm"),
    with_set("two rows", "resolution.spacing=0.125 mm", "solid.clamp_length=0.5 mm"),
    with_set("an artificial stress that is unstable", "solid.artificial_stress_coefficient=0.5"),
    with_set("a sound that is too slow", "fluid.sound_speed=10"),
    with_set("no viscosity", "fluid.artificial_viscosity_alpha=0"),
    with_set("no filter of the density", "fluid.density_correction_interval=0"),
    with_set("a stubby beam", "solid.length=0.75 mm", "drop.diameter=0.4 mm"),
    with_set("a liquid that outruns its sound", "fluid.sound_speed=21", "time.end=30 us"),
)

SECTIONS = (
    ("In the case file", CASE_FILE), ("On the command line", COMMAND_LINE), ("With files", FILES), ("At a restart", RESTART),
    ("When the case is set up or runs", SET_UP), ("In a file of particles", PARTICLES), ("Warnings: the run goes on", DOUBTS),
)
