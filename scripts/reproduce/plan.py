"""What is simulated, reconstructed and judged: the full run, and the quick one."""

import dataclasses
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONFIGS = ROOT / "configs/recon"
AT_FPS = ["esi", "esi-adaptive", "esi-flow", "accumulator", "accumulator-centred", "highpass", "complementary",
          "edi-propagated"]
AT_FRAMES = ["edi"]  # makes one image per intensity frame
METHODS = [*AT_FPS, *AT_FRAMES]
NETWORKS = ["firenet", "firenet-plus"]
WITHOUT_FRAMES = ["esi", "esi-adaptive", "esi-flow", "accumulator", "highpass"]  # what can be tuned on events alone

# Blocks of esi-adaptive, each off, or replaced, or added
ABLATION = {
    "esi-adaptive": {},
    "without-balance": {"balance": False},
    "without-blur": {"blur_px": 0},
    "clamp-2": {"e_min": -2, "e_max": 2},
    "median-for-blur": {"blur_px": 0, "median": True},
    "with-background": {"background_us": 10000},
    "with-background-without-balance": {"background_us": 10000, "balance": False},
}


@dataclasses.dataclass(frozen=True)
class Plan:
    name: str
    scoring: tuple  # seeds of flights, each also the seed of its scene
    tuning: tuple
    dark: tuple
    duration_s: int
    tuning_s: int
    dark_s: int  # the beginning of a flight of duration_s: all of it straight
    options: tuple  # of esi-sim
    every_cell: int  # 1: the whole grid of 64
    scoring_fps: int  # not a divisor of the intensity frames' rate: they shall not always be equally old
    dark_fps: int
    cost_part: tuple  # begin and end in s of each scoring flight, at 100 FPS
    tuning_part: tuple  # begin and end in s of each tuning flight, and its frames per second
    network_parts: tuple  # begin, begin of the judged part, end, in s of each scoring flight


FULL = Plan("full", (1, 2, 3), (11, 12), (201, 202, 203), 62, 12, 10, (), 1, 7, 15, (10, 15), (0, 12, 7),
            ((9.75, 10.0, 10.5), (39.75, 40.0, 40.5), (55.75, 56.0, 56.5)))
QUICK = Plan("quick", (1, 2, 3), (11, 12), (201,), 6, 3, 2, ("--scale", 0.5, "--height-m", 1.2), 9, 9, 15, (1, 4),
             (0, 3, 8), ())


def flight(plan, light, seed):
    """Name of a flight, and the arguments of esi-sim for it."""
    duration_s = plan.tuning_s if seed in plan.tuning else plan.duration_s
    name = f"{light}-{duration_s}s-seed{seed}"
    arguments = ["--config", f"{ROOT}/configs/sim/flight-{light}.json", "--seed", seed, "--scene-seed", seed,
                 "--duration", duration_s, "--write", "aedat4", "--threads", 1, *plan.options]
    if light == "dark":
        arguments += ["--end", plan.dark_s]
        name += f"-first{plan.dark_s}s"
    return name, arguments
