"""What a person puts into the script of the client, and what is said of the address."""

from __future__ import annotations

from rths_engine.planning.plan import Plan

LOOPBACK = ("127.0.0.1", "::1", "localhost")
EVERYWHERE = ("0.0.0.0", "::", "")


def lines(plan: Plan, host: str, port: int) -> dict[str, str]:
    """The line of an OpenSees script that connects to the rig, by language. TAG and NODE are numbers of the user's model."""
    nodes = [f"NODE{number}" for number in range(1, len(plan.stations) + 1)] if len(plan.stations) > 1 else ["NODE"]
    address = "ADDRESS" if host in EVERYWHERE else host
    udp = plan.client.transport == "udp"
    python = ["'genericClient'", "TAG", "'-node'", *nodes, *["'-dof', 1"] * len(nodes), "'-server'", str(port), f"'{address}'"]
    tcl = ["genericClient", "TAG", "-node", *nodes, *["-dof 1"] * len(nodes), "-server", str(port), address]
    return {
        "python": f"ops.element({', '.join(python + [chr(39) + '-udp' + chr(39)] * udp)})",
        "tcl": f"element {' '.join(tcl + ['-udp'] * udp)}",
    }


def warning(host: str) -> str | None:
    """A warning about an address that other machines reach; None for this machine only."""
    if host in LOOPBACK:
        return None
    return f"The rig listens on {host or 'every address'}: every machine that reaches this port can move the rig."
