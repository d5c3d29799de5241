"""Force that wanes as the battery empties."""

from dataclasses import dataclass
from math import exp, expm1

from diffbot_sim.parameters import parameter
from diffbot_sim.physics.compiled import compiled
from diffbot_sim.physics.effects.effect import Effect, Excitation
from diffbot_sim.physics.stages import Motion, Stage, Traction

# A gain that grows stops at e to this power, so that the longest run stays finite.
MOST_GROWTH = 10.0
# Below this share of a bend in time a fade is straight, to all digits.
STRAIGHT = 1e-9
# Bends, in times the length of the run, at which fits begin.
BENDS = (0.0, 1.0, 4.0)
# A fall may steepen by e in 50 s, as where a small battery is nearly empty. What steepens faster
# fits any wobble of a rough floor, and goes far astray behind the data fitted.
STEEPENING = -0.02


@compiled
def remaining(time: float, rate: float, bend: float) -> float:
    """Return the gain that is left."""
    turned = bend * time
    worn = time if abs(turned) < STRAIGHT else -expm1(min(-turned, MOST_GROWTH)) / bend
    return float(min(max(1.0 - rate * worn, 0.0), exp(MOST_GROWTH)))


@compiled
def fade(at: Motion, traction: Traction, rate: float, bend: float) -> Traction:
    """Scale both forces by the gain that is left at this time."""
    if rate == 0.0:
        return traction
    gain = remaining(max(at.time, 0.0), rate, bend)
    return Traction(traction.right * gain, traction.left * gain)


@dataclass(frozen=True)
class ActuatorFade(Effect):
    """Both forces times 1 - rate·(1 - exp(-bend·t))/bend, with t since the start of the run.

    A straight line at bend 0, exp(-rate·t) at bend = rate, a fall to 1 - rate/bend beyond. While
    rate = 0, bend is without meaning.
    """

    name = 'actuator_fade'
    meaning = 'force gain falls (+) or grows (-) with time, as a battery empties'
    source = 'discharge of batteries: Shepherd (1965), here its straight and exponential parts'
    stage = Stage.DRIVETRAIN
    kernel = fade
    is_of_time = True
    guesses = ((0.001, 0.0), (-0.001, 0.0), (0.01, 0.02), (-0.01, 0.02))
    shape = ('bend',)
    excitation = 'the same manoeuvres early and late in a long run'

    rate: float = parameter(
        0.0, unit='1/s', low=-0.05, high=0.05, scale=0.001, meaning='first rate at which it falls'
    )
    bend: float = parameter(
        0.0,
        unit='1/s',
        low=STEEPENING,
        high=1.0,
        scale=0.01,
        meaning='rate at which the fall slackens (+) or steepens (-)',
    )

    @classmethod
    def starts(cls, drive: Excitation) -> tuple[tuple[float, ...], ...]:
        """Try a straight fall and two that slacken within the run."""
        return tuple((0.001, min(bend / drive.duration, 1.0)) for bend in BENDS)
