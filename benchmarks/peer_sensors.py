"""What encoders and gyros make of a drive: slow odometry, twists that are means of counts."""

from dataclasses import dataclass, replace

import numpy as np
from peer_plant import Plant
from peer_recording import reckoned_of

from diffbot_sim.records import Array, Odometry, Run


@dataclass(frozen=True)
class Sensors:
    """Encoders of both wheels, and perhaps a gyro in their place for the turn rate.

    rate: of the odometry [Hz]; ticks: counts to a turn of a wheel; begun: share of the first tick
    that a wheel has behind it; noise and bias of the gyro [rad/s], nan where there is none.
    """

    rate: float
    noise: float = np.nan
    bias: float = 0.0
    ticks: int = 4096
    begun: float = 0.0

    @property
    def quiet(self) -> 'Sensors':
        """The same with a gyro that makes no errors; what counts miss is not the same again."""
        return replace(self, noise=0.0 * self.noise, bias=0.0, begun=0.5)


ENCODERS = {f'encoders {rate:g} Hz': Sensors(rate) for rate in (10.0, 20.0, 30.0)}
GYROS = {
    f'gyro {rate:g} Hz': Sensors(rate, 0.004, bias)
    for rate, bias in ((10.0, 0.007), (20.0, 0.0), (30.0, -0.007))
}
SENSORS = ENCODERS | GYROS


def sensed(run: Run, plant: Plant, sensors: Sensors, seed: int) -> Run:
    """Return what such sensors tell of a drive that was recorded often and without noise."""
    seen, time = run.odometry, np.arange(0.0, run.odometry.time[-1], 1.0 / sensors.rate)
    steps = np.diff(seen.time)[:, None] * 0.5 * (seen.twist[1:] + seen.twist[:-1])
    wheels = np.array([[1.0, 1.0], [plant.half, -plant.half]])
    way = np.vstack([np.zeros(2), np.cumsum(steps, axis=0)]) @ wheels
    rolled = np.column_stack([np.interp(time, seen.time, wheel) for wheel in way.T])
    tick = 2.0 * np.pi * plant.radius / sensors.ticks
    counts = np.floor(rolled / tick + sensors.begun)
    twist = np.diff(counts, axis=0) * tick * sensors.rate @ np.linalg.inv(wheels)
    if np.isfinite(sensors.noise):
        turning = np.interp(time[1:], seen.time, seen.twist[:, 1])
        twist[:, 1] = turning + _errors(sensors, len(turning), seed)
    pose = reckoned_of(np.vstack([np.zeros(2), twist / sensors.rate]))[1:]
    return replace(run, odometry=Odometry(time[1:], twist, pose))


def _errors(sensors: Sensors, count: int, seed: int) -> Array:
    random = np.random.default_rng([seed, 4])
    return np.asarray(sensors.bias + sensors.noise * random.normal(size=count))
