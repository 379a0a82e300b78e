"""What becomes of each command that the documents show: it is run here, another test runs it, or it says why none does."""

from __future__ import annotations

# Run in a tree of links to this one, after a short quick start, in this order, with the words behind it added so that it
# takes a moment.
QUICKSTART = ("cases/quickstart/case.cfg", "--output", "results/quickstart", "--set", "resolution.spacing=62.5 um", "--until", "3e-5")
BRIEFLY = "--set time.end=2e-7"
RUN: dict[str, str] = {
    "build/release/src/sphdrop --list-parameters": "",
    "build/release/src/sphdrop --check my_drop.cfg": "",
    "build/release/src/sphdrop --print-case my_drop.cfg": "",
    "mpirun -np 2 build/release/src/sphdrop my_drop.cfg": BRIEFLY,
    "mpirun -np 2 build/release/src/sphdrop cases/cantilever/case.cfg --output results/cantilever": BRIEFLY,
    "mpirun -np 2 build/release/src/sphdrop cases/cantilever/case.cfg --set solid.length=12e-3 --until 1e-3": BRIEFLY,
    "mpirun -np 2 build/release/src/sphdrop cases/cantilever/case.cfg --output results/cantilever --max-walltime 0:30": BRIEFLY,
    "mpirun -np 2 build/release/src/sphdrop cases/cantilever/case.cfg --output results/cantilever --restart latest": BRIEFLY,
    "cases/sphdrop-view results/cantilever": "--only page",
    "cases/sphdrop-sweep table 'solid.length=8 mm;12 mm' 'drop.velocity=[0, -0.5];[0, -1]' > table.csv": "",
    "/usr/bin/python3 cases/compare.py --list": "",
    "/usr/bin/python3 cases/modal_beam.py results/quickstart": "",
    "/usr/bin/python3 tests/benchmarks/scaling/model.py figure results/scaling.png": "",
    "/usr/bin/python3 cases/lobed_droplet/make_drops.py --folder results/finer --spacing 1.25e-5": "",
    "build/release/src/sphdrop cases/lobed_droplet/case.cfg --set drop.particles_file=../../results/finer/mode_4.csv --set resolution.spacing=1.25e-5 --output results/lobed_finer": BRIEFLY,
}

# By CTest's names, with a word that the test's file holds.
TESTED: dict[str, tuple[str, str]] = {
    "cases/sphdrop-view results/quickstart": ("cases.view", "test_one_run"),
    "cases/sphdrop-view results/quickstart results/cantilever --output results/compared": ("cases.view", "test_several_runs"),
    "cases/sphdrop-view results/cantilever --follow": ("cases.view", "test_following_a_run"),
    "cases/sphdrop-sweep run table.csv cases/quickstart/case.cfg results/sweep --parallel 2":
        ("cases.sweep", "test_runs_are_made_once_and_taken_up"),
    "/usr/bin/python3 cases/compare.py --level quick": ("cases.compare", "test_everything_is_run_once_and_reported"),
    "/usr/bin/python3 cases/compare.py": ("comparison_short", '"--level", "short"'),
    "/usr/bin/python3 cases/compare.py rigid_wall cantilever/L8_U0.8": ("cases.compare", "test_named_runs_only"),
    "/usr/bin/python3 cases/compare.py '*/*_modern'": ("cases.compare", '"*/*_modern"'),
    "/usr/bin/python3 cases/compare.py --report-only --update-comparison": ("cases.compare", "--update-comparison"),
    "/usr/bin/python3 cases/cantilever/plot.py results/comparison/paper/cantilever --output results/figures":
        ("cases.compare", "test_plot_runs_alone"),
    "jobs/quickstart.sh": ("repository.scripts", "jobs/quickstart.sh"),
    "sbatch --ntasks=16 --time=4:00:00 jobs/run.sbatch cases/cantilever/case.cfg --output results/cantilever":
        ("cluster.job_scripts", "run.sbatch"),
    "sbatch --ntasks=16 --time=4:00:00 jobs/requeue.sbatch cases/cantilever/case.cfg results/cantilever":
        ("cluster.slurm", "requeue.sbatch"),
    "jobs/sweep.sh jobs/sweep_table.csv cases/cantilever/case.cfg results/sweep --ntasks=4 --time=4:00:00":
        ("cluster.slurm", "sweep.sh"),
    "sbatch --ntasks=16 jobs/strong_scaling.sbatch cases/cantilever/case.cfg results/strong --until 1e-4":
        ("cluster.slurm", "_scaling.sbatch"),
    "sbatch --ntasks=16 jobs/weak_scaling.sbatch cases/cantilever/case.cfg results/weak --until 1e-4":
        ("cluster.slurm", "_scaling.sbatch"),
    "mpirun --host a:8,b:8 -np 16 --mca oob_tcp_keepalive_time 5 --mca oob_tcp_keepalive_intvl 2 --mca oob_tcp_keepalive_probes 2 "
    "build/release/src/sphdrop cases/cantilever/case.cfg --output results/cantilever --restart auto":
        ("cluster.hosts", "oob_tcp_keepalive_time"),
    "/usr/bin/python3 tests/benchmarks/scaling/model.py page": ("benchmarks.scaling_model", "test_its_tables_are_those_of_the_model"),
    "/usr/bin/python3 tests/benchmarks/whole_program.py --repeats 3": ("benchmarks.whole_program", "test_goes_on_from_a_checkpoint_to_the_same_state_on_both_numbers_of_ranks"),
    "SPHDROP_ARCH=x86-64-v3 sphdrop --version": ("repository.instruction_sets", "SPHDROP_ARCH"),
    'cmake -G Ninja -S cases/probe -B build/probe -DCMAKE_PREFIX_PATH="$HOME/.local" && cmake --build build/probe':
        ("repository.library", "share/sphdrop/cases/probe"),
    "mpirun -np 2 build/probe/probe cases/quickstart/case.cfg results/probe": ("repository.library", "build/probe"),
}

NOT_RUN: dict[str, str] = {
    "tests/run.sh": "it is what runs the tests",
    "cmake --preset release": "tests/run.sh does before the tests",
    "cmake --build --preset release": "tests/run.sh does before the tests",
    "ctest --preset release": "tests/run.sh does, and this test with it",
    "cmake --preset package && cmake --build --preset package": "a second build of all: repository.instruction_sets with SPHDROP_LONG_TESTS=1; another test installs the first one",
    "cmake --install build/package --prefix ~/.local": "repository.packaging installs another build elsewhere",
    "jobs/install_packages.sh --packaging": "it changes the machine; tests/run.sh installs the same with --tests",
    "cd build/package && cpack && sudo apt install ./sphdrop_*.deb": "it changes the machine; repository.packaging makes the package of another build",
    "pvbatch cases/view/paraview_scene.py results/quickstart --picture scene.png --state scene.pvsm": "ParaView is not among the tests' packages",
    "SPHDROP_LONG_TESTS=1 ctest --preset release --verbose -L 'fault|restart'": "takes most of an hour",
    "mpirun -n 32 build/release/src/sphdrop cases/oscillating_droplet/case.cfg --set drop.diameter=4e-3 --until 6e-7 --output results/count":
        "32 ranks on a few cores take a minute",
    "python3 tests/fault/checkpoint_cost.py": "a measurement, of which a test could not judge",
}
