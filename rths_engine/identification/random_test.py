"""The random test of an identification: band-limited noise at a small amplitude, within the limits of its station."""

from __future__ import annotations

from pydantic import Field, model_validator

from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.foundation.part import Value, quantity
from rths_engine.parts.compensators.none import NoCompensation
from rths_engine.planning.checks import peaks
from rths_engine.planning.excitation import Drive
from rths_engine.planning.plan import Plan, Station
from rths_engine.planning.shapes import BandNoise

# chosen; see docs/decisions/0023
LEAST = 1e-6  # m, smallest peak
SMALL = 5e-3  # m, largest peak that is chosen without being asked for
OF_STROKE = 0.1  # of the displacement limit
OF_VELOCITY = 0.3  # of the velocity limits


class RandomTest(Value):
    """Settings of a random test of one station. Without an amplitude, it is the largest that stays well within the limits."""

    seconds: float = quantity("Duration of the random test", "s", ge=5, le=60, default=20.0)
    low_frequency: float = quantity("Lowest frequency", "Hz", ge=0.05, le=50, default=0.25)
    high_frequency: float = quantity("Highest frequency", "Hz", ge=0.5, le=100, default=6.0)
    amplitude: float | None = quantity(
        "Peak displacement", "m", "mm", ge=LEAST, le=1, default=None, help="empty: chosen from the limits"
    )
    seed: int = Field(0, title="Seed", ge=0, le=2**63 - 2)

    @model_validator(mode="after")
    def _band(self) -> RandomTest:
        if self.high_frequency < 2 * self.low_frequency:
            raise ValueError(f"the highest frequency needs to be at least twice the lowest, {self.low_frequency:g} Hz")
        return self

    def plan(self, plan: Plan, number: int, share: float = 1.0) -> Plan:
        """The plan of the random test of station `number` (from 1), at `share` of its amplitude. Raises PlanError."""
        station = self._station(plan, number)
        if plan.controller_rate < 10 * self.high_frequency:
            fix = "lower the highest frequency"
            problem = f"needs a controller rate of at least ten times it; the plan has {plan.controller_rate:g} Hz"
            raise PlanError(Issue("high_frequency", problem, self.high_frequency, fix))
        shape = BandNoise(
            low_frequency=self.low_frequency, high_frequency=self.high_frequency, duration=self.seconds, seed=self.seed
        )
        amplitude = self._amplitude(station, shape, plan.controller_rate)
        return Plan(
            name=f"Identification of {station.name}"[:200],
            test="specimen",
            drive=Drive(amplitude=share * amplitude, shape=shape),
            controller_rate=plan.controller_rate,
            stations=(station,),
            pace=plan.pace,  # a machine needs real time
            seed=self.seed + 1,  # another one than the seed of the command
        )

    def _station(self, plan: Plan, number: int) -> Station:
        if not 1 <= number <= len(plan.stations):
            problem = f"the plan has {len(plan.stations)} station(s)"
            raise PlanError(Issue("station", problem, number, "give the number of a station of the plan, from 1"))
        update = {"compensator": NoCompensation(), "storey": 1, "dampers": 1}
        update |= {"equivalent_stiffness": 0.0, "equivalent_damping": 0.0}  # of a computed structure, which the test has not
        return plan.stations[number - 1].model_copy(update=update)

    def _amplitude(self, station: Station, shape: BandNoise, rate: float) -> float:
        fastest = peaks(Drive(amplitude=1.0, shape=shape), self.seconds, rate)[1]
        velocity = min(station.limits.velocity, station.actuator.velocity_limit)
        if self.amplitude is None:
            chosen = min(SMALL, OF_STROKE * station.limits.displacement, OF_VELOCITY * velocity / fastest)
            if chosen < LEAST:
                problem = f"would be {1e3 * chosen:.3g} mm within the limits of the station and its actuator"
                raise PlanError(Issue("amplitude", f"{problem}; a test needs {1e3 * LEAST:g} mm", None, "raise the limits"))
            return chosen
        most = min(station.limits.displacement, velocity / fastest)
        if self.amplitude > most:
            problem = f"exceeds what the limits of the station and its actuator allow in this band, {1e3 * most:.3g} mm"
            raise PlanError(Issue("amplitude", problem, self.amplitude, "lower the amplitude, or leave it out"))
        return self.amplitude
