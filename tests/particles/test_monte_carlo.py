import math

import numpy as np
import pytest

from ial.contractors.threads import set_threads
from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.scan import LaserScan
from ial.datasets.simulator import Lidar, SensorErrors, Simulation, simulate
from ial.datasets.walk import random_walk
from ial.errors import ConfigError, MapError
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.particles.likelihood_field import BeamModel
from ial.particles.monte_carlo import Cloud, MonteCarlo, MonteCarloConfig
from ial.particles.odometry_model import OdometryModel
from ial.pose import Pose, wrap

CALM = OdometryModel(0.02, 0.005, 0.02, 0.02)
WHEELS = MotionBounds(ErrorBound(0.02, 0.02, 0.02), ErrorBound(0.02, 0.02, 0.02))


def run(seed: int, scans: int = 25) -> tuple[OccupancyGrid, Simulation]:
    grid = floor_plan(12.0, 10.0, 0.05, seed)
    path = random_walk(grid, scans, seed)
    return grid, simulate(grid, path, Lidar(beams=181, range_max=12.0), SensorErrors(0.03, 0.002, 10), WHEELS, seed)


def follow(particles: MonteCarlo, recording: InMemoryRecording) -> list[Cloud]:
    return [particles.update(reading.odometry.pose, reading.scan) for reading in recording.readings()]


@pytest.mark.parametrize("kind", ["likelihood_field", "likelihood_field_prob"])
@pytest.mark.parametrize("seed", range(4))
def test_a_robot_is_followed_from_a_known_pose(seed: int, kind: str) -> None:
    grid, simulation = run(seed)
    truth = [Pose(*pose) for pose in simulation.truth.poses.tolist()]
    config = MonteCarloConfig(particles=2000, odometry=CALM, beam=BeamModel(max_beams=36, laser_model_type=kind))  # type: ignore[arg-type]
    clouds = follow(MonteCarlo(grid, config, seed, truth[0], (0.2, 0.1)), simulation.recording)
    errors = [math.hypot(cloud.pose.x - pose.x, cloud.pose.y - pose.y) for cloud, pose in zip(clouds, truth, strict=True)]
    assert np.median(errors) < 0.2
    assert max(errors) < 0.6
    assert all(cloud.deviation_m < 0.6 for cloud in clouds)


@pytest.mark.slow
def test_a_robot_is_found_on_the_whole_map() -> None:
    right = 0
    for seed in range(4):
        grid, simulation = run(seed)
        last = follow(MonteCarlo(grid, MonteCarloConfig(odometry=CALM), seed), simulation.recording)[-1].pose
        end = Pose(*simulation.truth.poses[-1].tolist())
        right += math.hypot(last.x - end.x, last.y - end.y) < 0.3 and abs(wrap(last.theta - end.theta)) < 0.1
    assert right >= 3


def test_a_seed_gives_the_same_bits_on_any_number_of_threads() -> None:
    grid, simulation = run(1, scans=6)
    runs = []
    for threads in (1, 2):
        set_threads(threads)
        try:
            runs.append([follow(MonteCarlo(grid, MonteCarloConfig(), seed), simulation.recording) for seed in (1, 2)])
        finally:
            set_threads(None)
    assert runs[0] == runs[1]
    assert runs[0][0] != runs[0][1]


def test_a_scan_without_a_usable_beam_moves_the_particles_and_no_more() -> None:
    grid, simulation = run(2, scans=2)
    particles = MonteCarlo(grid, MonteCarloConfig(particles=500, first_particles=500, resample_below=0.0), 1)
    first, second = simulation.recording.readings()
    blind = LaserScan(first.stamp_ns, np.full(10, np.nan, dtype=np.float32), 0.0, 0.1)
    particles.update(first.odometry.pose, blind)
    before = particles.poses.copy()
    particles.update(second.odometry.pose, blind)
    assert particles.weights == pytest.approx(1.0 / 500)
    assert not np.array_equal(before, particles.poses)


@pytest.mark.parametrize("fast", [0.0, 0.4])
def test_random_particles_are_mixed_in_when_scans_fit_worse_than_before_and_recovery_is_on(fast: float) -> None:
    grid, simulation = run(3)
    readings = list(simulation.recording.readings())
    start = Pose(*simulation.truth.poses[0].tolist())
    config = MonteCarloConfig(odometry=CALM, resample_below=1.0, recovery_alpha_slow=0.05 * fast, recovery_alpha_fast=fast)
    particles = MonteCarlo(grid, config, 5, start, (0.05, 0.02))

    def farthest() -> float:
        return float(np.hypot(*(particles.poses[:, :2] - np.median(particles.poses[:, :2], axis=0)).T).max())

    for reading in readings[:20]:
        particles.update(reading.odometry.pose, reading.scan)
    assert farthest() < 2.0
    particles.poses[:, 2] += math.pi
    particles.update(readings[20].odometry.pose, readings[20].scan)
    assert farthest() > 4.0 if fast else farthest() < 2.0


def test_free_cells_are_what_the_first_particles_are_drawn_from() -> None:
    cells = np.full((20, 30), OCCUPIED, dtype=np.uint8)
    cells[5:8, 10:20] = FREE
    grid = OccupancyGrid(cells, 0.1)
    poses = MonteCarlo(grid, MonteCarloConfig(first_particles=2000), 0).poses
    assert poses.min(axis=0) == pytest.approx([1.0, 0.5, -math.pi], abs=0.02)
    assert poses.max(axis=0) == pytest.approx([2.0, 0.8, math.pi], abs=0.02)


@pytest.mark.parametrize(
    "wrong",
    [
        {"particles": 0},
        {"first_particles": 2.5},
        {"least_effective": 1.5},
        {"resample_below": -0.1},
        {"roughening_m": math.nan},
        {"recovery_alpha_slow": 0.2, "recovery_alpha_fast": 0.1},
    ],
)
def test_a_number_outside_its_range_is_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(ConfigError, match=next(iter(wrong))):
        MonteCarloConfig(**wrong)  # type: ignore[arg-type]


def test_a_map_without_obstacles_is_refused() -> None:
    with pytest.raises(MapError):
        MonteCarlo(OccupancyGrid(np.full((5, 5), FREE, dtype=np.uint8), 0.1))
