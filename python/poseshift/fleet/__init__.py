"""Many robots, every night: programs are compensated and checked, measurements are diagnosed, what is known is kept.

`poseshift-fleet run fleet.yaml --store STORE`. A result is named by the hash of all that it depends on, so that only what has
changed is made again; backups are read and never written.
"""

from poseshift.fleet.collect import Summary, collect
from poseshift.fleet.config import Fleet, FleetError, Robot, read
from poseshift.fleet.drift import Part, parts
from poseshift.fleet.executors import run_local, run_ray
from poseshift.fleet.store import Store
from poseshift.fleet.units import Plan, Unit, plan

__all__ = [
    "Fleet",
    "FleetError",
    "Part",
    "Plan",
    "Robot",
    "Store",
    "Summary",
    "Unit",
    "collect",
    "parts",
    "plan",
    "read",
    "run_local",
    "run_ray",
]
