# SPDX-License-Identifier: Apache-2.0
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any

import numpy
import pandas
import xarray

__version__: str

_Path = str | PathLike[str]
_Progress = Callable[[str, float], bool | None] | None
_Arrays = dict[str, dict[str, numpy.ndarray | list[str]]]

class Error(Exception): ...
class BadInput(Error): ...
class BadArgument(Error): ...
class Cancelled(Error): ...

class Port:
    name: str
    device: str
    baud: int

class Recording:
    ports: list[Port]
    remarks: list[str]
    def __init__(self, file: _Path, config: _Path | None = None) -> None: ...
    def configuration(self) -> str: ...
    def arrays(self, progress: _Progress = None) -> _Arrays: ...

class Pipeline:
    ports: list[Port]
    def __init__(self, config: _Path) -> None: ...
    @staticmethod
    def from_text(toml: str) -> Pipeline: ...
    def push(self, port: str, arrival_ns: int, bytes: bytes) -> _Arrays: ...
    def advance(self, now_ns: int) -> _Arrays: ...

class Quantity:
    name: str
    value: float
    std_error: float

class CalibratorResult:
    name: str
    verdict: str
    judgement: str
    accepted: bool
    reason: str
    manoeuvre: str
    coverage: float
    condition: float
    samples: int
    estimate: list[Quantity]

class Calibration:
    calibrators: list[CalibratorResult]
    duration_s: float
    remarks: list[str]
    json: str
    def as_dict(self) -> dict[str, Any]: ...

class EffectParameter:
    name: str
    value: float
    std_error: float

class Effect:
    name: str
    of: str
    probability: float
    parameters: list[EffectParameter]

class Diagnosis:
    verdict: str
    sentence: str
    effects: list[Effect]
    candidates: list[Effect]
    unexplained: list[str]
    next: list[str]
    remarks: list[str]
    duration_s: float
    seconds: float
    json: str
    effects_toml: str
    layout_toml: str
    def as_dict(self) -> dict[str, Any]: ...

def calibrate(files: Sequence[_Path], config: _Path | None = None, progress: _Progress = None) -> Calibration: ...
def simulate(
    capture: _Path,
    progress: _Progress = None,
    *,
    mission: str | None = None,
    drive: _Path | None = None,
    path: _Path | None = None,
    vehicle: _Path | None = None,
    config: _Path | None = None,
    effects: Mapping[str, float] | None = None,
    effects_file: _Path | None = None,
    clocks: Mapping[str, float] | None = None,
    seconds: float | None = None,
    place: Sequence[float] | None = None,
    field_uT: Sequence[float] | None = None,
    date: str | None = None,
    seed: int | None = None,
    noise: bool | None = None,
    truth: _Path | None = None,
) -> list[str]: ...
def diagnose(
    missions: _Path | Sequence[_Path],
    progress: _Progress = None,
    *,
    holdouts: Sequence[_Path] | None = None,
    nominals: Sequence[_Path] | None = None,
    steady: bool | None = None,
    vehicle: _Path | None = None,
    config: _Path | None = None,
    field_uT: Sequence[float] | None = None,
    exclude: Sequence[str] | None = None,
    without: Sequence[str] | None = None,
    bank: int | None = None,
    seed: int | None = None,
    cache: _Path | None = None,
    threads: int | None = None,
) -> Diagnosis: ...

class NextMission:
    decides: bool
    probability_now: float
    probability_exact: float
    duration_s: float
    manoeuvres: list[str]
    sentence: str
    remarks: list[str]
    mission_toml: str
    json: str
    page: str
    def as_dict(self) -> dict[str, Any]: ...

def plan_next_mission(
    missions: _Path | Sequence[_Path],
    progress: _Progress = None,
    *,
    minutes: float | None = None,
    limits: _Path | None = None,
    mission_out: str | None = None,
    holdouts: Sequence[_Path] | None = None,
    vehicle: _Path | None = None,
    config: _Path | None = None,
    field_uT: Sequence[float] | None = None,
    exclude: Sequence[str] | None = None,
    without: Sequence[str] | None = None,
    bank: int | None = None,
    seed: int | None = None,
    cache: _Path | None = None,
    threads: int | None = None,
) -> NextMission: ...
def frames(arrays: _Arrays) -> dict[str, pandas.DataFrame]: ...
def datasets(arrays: _Arrays) -> dict[str, xarray.Dataset]: ...
def columns(table: pandas.DataFrame | xarray.Dataset) -> dict[str, numpy.ndarray | list[str]]: ...
