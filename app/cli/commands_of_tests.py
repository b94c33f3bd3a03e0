"""Commands that execute or predict tests on this machine."""

from __future__ import annotations

from pathlib import Path

from app.cli.command import Commands, command, data_folder


def add(commands: Commands) -> None:
    """Declare the commands."""
    plan = command(commands, "plan", "app.cli.plans:plan", "print a template as YAML, or list the templates")
    plan.add_argument(
        "name", nargs="?", metavar="NAME", help="name of the template, for example table3-04; without it, list all"
    )

    run = command(commands, "run", "app.cli.run:run", "run a plan on this machine, without a server")
    run.add_argument("plan", metavar="PLAN.yaml", help="file with the plan; - reads standard input")
    run.add_argument("--out", type=Path, metavar="REC.h5", help="file to write the recording to (HDF5)")
    run.add_argument("--json", action="store_true", help="print the result as one JSON object")
    run.add_argument(
        "--record", metavar="FILE", help="ground motion (AT2, COSMOS V2 or columns) that replaces the plan's record"
    )
    run.add_argument("--record-unit", metavar="UNIT", help="unit of the record if its file does not state it: g, cm/s^2, ...")
    run.add_argument(
        "--record-dt", metavar="TIME", help="time step of the record if its file does not state it: 0.01, '5 ms', ..."
    )
    data_folder(run)

    about = "measure whether this machine meets the deadlines of a test in real time; exit code 1 where a step missed"
    deadline = command(commands, "deadline", "app.cli.deadline:deadline", about)
    deadline.add_argument("--plan", metavar="PLAN.yaml", help="plan whose steps are executed (default: template two-storeys)")
    deadline.add_argument("--rate", type=float, metavar="HZ", help="steps a second (default: controller rate of the plan)")
    deadline.add_argument("--steps", type=int, metavar="N", help="number of steps (default: a minute)")
    deadline.add_argument("--core", type=int, metavar="C", help="core to pin the loop to, counted from 0 (default: any)")
    deadline.add_argument("--priority", type=int, metavar="P", help="real-time priority, 1 to 99 (default: ordinary)")
    deadline.add_argument("--json", action="store_true", help="print the result as one JSON object")
    data_folder(deadline)

    about = "let another program, such as OpenSees, drive the rig of a plan: docs/opensees-rig.md"
    rig = command(commands, "rig", "app.cli.rig:rig", about)
    rig.add_argument("plan", metavar="PLAN.yaml", help="file with a plan of the kind client; - reads standard input")
    rig.add_argument("--listen", type=int, metavar="PORT", help="port to listen on (default: that of the plan)")
    rig.add_argument("--udp", action="store_true", help="listen by UDP (default: the transport of the plan)")
    rig.add_argument("--host", default="127.0.0.1", help="address to listen on (default %(default)s: this machine only)")
    rig.add_argument("--out", type=Path, metavar="REC.h5", help="file to write the recording to (HDF5)")
    rig.add_argument("--json", action="store_true", help="print the result as one JSON object")

    about = "simulate a plan before it is queued: would it trip, when and where, with its peaks against limits"
    preflight = command(commands, "preflight", "app.cli.preflight:preflight", about)
    preflight.add_argument("plan", metavar="PLAN.yaml", help="file with the plan; - reads standard input")
    preflight.add_argument("--json", action="store_true", help="print the result as one JSON object")
    data_folder(preflight)

    about = "identify the delay of a station by a short random test of its emulated actuator and specimen"
    identify = command(commands, "identify", "app.cli.identify:identify", about)
    identify.add_argument("plan", metavar="PLAN.yaml", help="file with the plan; - reads standard input")
    identify.add_argument("--station", type=int, default=1, metavar="N", help="station, from 1 (default %(default)s)")
    identify.add_argument("--seconds", type=float, default=20.0, help="duration of the random test (default %(default)g)")
    identify.add_argument("--low", type=float, default=0.25, metavar="HZ", help="lowest frequency (default %(default)g)")
    identify.add_argument("--high", type=float, default=6.0, metavar="HZ", help="highest frequency (default %(default)g)")
    identify.add_argument("--amplitude", metavar="LENGTH", help="peak, such as '2 mm' (default: from the limits)")
    identify.add_argument("--seed", type=int, default=0, help="seed of the random command (default %(default)s)")
    identify.add_argument("--rig", action="store_true", help="move the external rig of the station (default: its models)")
    identify.add_argument("--json", action="store_true", help="print the result as one JSON object")
    data_folder(identify)

    sweep = command(commands, "sweep", "app.cli.sweep:sweep", "execute a sweep on all cores of this machine, without a server")
    sweep.add_argument("sweep", type=Path, metavar="SWEEP.yaml", help="file with the definition of the sweep: docs/sweeps.md")
    sweep.add_argument(
        "--out", type=Path, metavar="FILE", help="file to write the results to: .csv, .parquet or .arrow (default SWEEP.csv)"
    )
    sweep.add_argument("--json", action="store_true", help="also print the results as one JSON object")
    sweep.add_argument("--count", action="store_true", help="only print the number of points")
    sweep.add_argument("--processes", type=int, metavar="N", help="points at the same time (default: one for each core)")
    data_folder(sweep)

    stability = command(commands, "stability", "app.cli.stability:stability", "predict whether a plan's closed loop is stable")
    stability.add_argument(
        "plan", nargs="?", metavar="PLAN.yaml", help="file with the plan; without it, print a published limit"
    )
    stability.add_argument("--json", action="store_true", help="print the result as one JSON object")

    table4 = command(
        commands, "table4", "app.cli.table4:table4", "run the twelve simulations of Table IV and compare them with the paper"
    )
    table4.add_argument("--record", metavar="FILE", help="ground motion that replaces the bundled record")
    table4.add_argument("--record-unit", metavar="UNIT", help="unit of the record if its file does not state it (default g)")
    table4.add_argument("--record-dt", metavar="TIME", help="time step if the file does not state it (default 0.02 s)")
    table4.add_argument(
        "--factor",
        type=float,
        metavar="F",
        help="scale factor of the record (default: the factor that fits the floor peaks of simulation 2)",
    )
    table4.add_argument("--json", type=Path, metavar="OUT", help="write the table as one JSON object")

    about = "run every compensator on the virtual RTHS benchmark and on perturbed plants, and store the league"
    league = command(commands, "league", "app.cli.league:league", about)
    league.add_argument("--case", type=int, default=1, metavar="N", help="partitioning case 1 to 4 (default %(default)s)")
    league.add_argument(
        "--record",
        default="imperial-valley-1940-el-centro-ns",
        metavar="NAME",
        help="record of the library, scaled by 0.4 (default %(default)s)",
    )
    league.add_argument("--plants", type=int, default=20, metavar="N", help="perturbed plants (default %(default)s)")
    league.add_argument("--only", nargs="+", default=[], metavar="KIND", help="kinds of compensators, for example ats inverse")
    league.add_argument("--processes", type=int, metavar="N", help="tests at the same time (default: one for each core)")
    league.add_argument(
        "--out", type=Path, metavar="OUT.json", help="file to write (default: that of the page, in the data folder)"
    )
    data_folder(league)
