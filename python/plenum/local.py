"""The computations, done here by the extension module. The GIL is released while they run, and Ctrl-C stops them."""
from __future__ import annotations

import contextlib
import json
import os
import pathlib
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Mapping, Optional, Sequence, Union

import numpy as np

from . import _core
from .answers import Designs, Diagnosis, Evaluation, Map, Protocol, Response, SweepTable, Verification, answer_of
from .catalogue import locate
from .documents import Source, document_of, encode, read_bytes, text_of
from .errors import InputError
from .progress import Progress, listener

if TYPE_CHECKING:
    import pandas as pd

CHUNK = 500  # simulations whose text is in memory at once
Catalog = Union[None, str, "os.PathLike[str]"]
Measured = Union[Source, "pd.DataFrame", Sequence[Union[Source, "pd.DataFrame"]]]


@contextlib.contextmanager
def _watched(progress: Progress) -> Iterator[Optional[Callable[[str], None]]]:
    """What hears the news; an exception that stopped the work carries the best answer so far in `.answer`."""
    hear, close = listener(progress)
    try:
        yield hear
    except BaseException as stopped:
        text = getattr(stopped, "answer", None)
        if isinstance(text, str):
            stopped.answer = answer_of(json.loads(text))  # type: ignore[attr-defined]
        raise
    finally:
        close()


def with_ranking(requirements: dict[str, Any], top: Optional[int], time_limit_s: Optional[float],
                 proof: bool) -> dict[str, Any]:
    """The requirements with what the arguments say instead."""
    for field, value in (("count", top), ("time_limit_s", time_limit_s), ("proof", proof or None)):
        if value is not None:
            requirements["ranking"] = {**(requirements.get("ranking") or {}), field: value}
    return requirements


def design(requirements: Source, *, top: Optional[int] = None, time_limit_s: Optional[float] = None,
           proof: bool = False, catalog: Catalog = None, progress: Progress = None) -> Designs:
    """Ranked designs for requirements (a dict, or the path of a JSON file), with their proof.

    top, time_limit_s and proof stand in ranking of the requirements. progress: True for a bar, False for none (None: a
    bar on a terminal), or a function of a dict. Ctrl-C stops the search: KeyboardInterrupt carries the best answer so
    far in `.answer`.
    """
    request = with_ranking(document_of(requirements), top, time_limit_s, proof)
    with _watched(progress) as hear:
        return Designs(json.loads(_core.design(encode(request), locate(catalog), hear)))


def sweep(request: Source, *, catalog: Catalog = None, progress: Progress = None) -> SweepTable:
    """The best design for each of many requirements that differ in a few fields (sweep/1): a table, with pandas as
    `.frame`. Ctrl-C stops it: KeyboardInterrupt carries what is done in `.answer`.
    """
    with _watched(progress) as hear:
        return SweepTable(json.loads(_core.sweep(text_of(request), locate(catalog), hear)))


def evaluate(request: Source, *, catalog: Catalog = None) -> Evaluation:
    """How given parts do at given settings against requirements (evaluation/1)."""
    return Evaluation(json.loads(_core.evaluate(text_of(request), locate(catalog))))


def simulate(request: Source, *, catalog: Catalog = None) -> Response:
    """Pressures of one given design over time (simulation/1)."""
    return answer_of(json.loads(_core.simulate(text_of(request), locate(catalog))))


def protocol(part: str, *, catalog: Catalog = None, **sensor: float) -> Protocol:
    """How to measure a part of the catalogue, and how precise that will be with a sensor (protocol/1).

    sensor: sensor_noise_kpa, sensor_resolution_kpa, sampling_hz, bottle_l, bottle_uncertainty; see
    docs/reference/protocols.md.
    """
    texts = {name: str(value) for name, value in sensor.items()}
    return Protocol(json.loads(_core.protocol(locate(catalog), part, texts)))


def simulate_many(requests: Iterable[Source], *, threads: Optional[int] = None, catalog: Catalog = None,
                  progress: Progress = False) -> list[Union[Response, InputError]]:
    """Many simulations on all processors. A request that is refused has its InputError in its place.

    In these answers arrays stand in place of lists, with all their digits. Ctrl-C: KeyboardInterrupt has the answers so
    far in `.answer`.
    """
    texts = [text_of(request) for request in requests]
    threads, place = threads or len(os.sched_getaffinity(0)), locate(catalog)
    answers: list[Union[Response, InputError]] = []
    with _watched(progress) as hear:
        try:
            for begin in range(0, len(texts), CHUNK):
                told = None if hear is None else _shifted(hear, begin, len(texts))
                done = _core.simulate_many(texts[begin : begin + CHUNK], place, threads, told)
                answers += [_response_or_error(*answer) for answer in done]
        except BaseException as stopped:
            done = getattr(stopped, "answer", [])
            answers += [_response_or_error(*answer) for answer in done if answer[0]]
            stopped.answer = answers  # type: ignore[attr-defined]
            raise
    return answers


def _shifted(hear: Callable[[str], None], begin: int, count: int) -> Callable[[str], None]:
    """News of a chunk as news of the whole."""

    def tell(news: str) -> None:
        hear(json.dumps({"done": begin + json.loads(news)["done"], "of": count}))

    return tell


def _response_or_error(text: str, arrays: list[np.ndarray]) -> Union[Response, InputError]:
    document = json.loads(text, object_hook=lambda found: arrays[found["$array"]] if "$array" in found else found)
    if "errors" in document:
        return InputError([(error["pointer"], error["detail"]) for error in document["errors"]])
    return answer_of(document)


def map(request: Source) -> Map:  # the name of the contract
    """Normalised rise and fall times over a grid (map/1)."""
    return Map(json.loads(_core.map(text_of(request))))


def _decoded(text: Union[str, bytes], name: str) -> str:
    try:
        return text if isinstance(text, str) else text.decode("utf-8")
    except UnicodeDecodeError as error:
        raise InputError([("", f"{name}: cannot be read: {error}")]) from error


def _rig_of_table(rig: Source, table: Optional[Mapping[str, Any]]) -> str:
    """The rig's document with the answers to what a table leaves open."""
    if not table:
        return text_of(rig)
    document = document_of(rig)
    if "rig" not in document and "schema" not in document:
        document = {"rig": document}
    return encode({**document, "csv": {**(document.get("csv") or {}), **table}})


def measurements(data: Measured, rig: Optional[Source] = None, table: Optional[Mapping[str, Any]] = None
                 ) -> tuple[list[str], list[tuple[str, Union[str, bytes]]]]:
    """Documents measurement/1 as text, and what they were made from: name and content.

    data: a measurement (dict or path of JSON), a table (frame or path of CSV of any dialect), for which `rig` describes
    what was measured; or a list of these. table answers what a table leaves open, which an InputError asks:
    {"columns": {"p": "pressure_kpa_gauge [bar abs]"}, "delimiter": …, "decimal": …, "encoding": …, "header_row": …}.
    What was understood of a table stands in "understood" of its document.
    """
    if not isinstance(data, (list, tuple)):
        data = [data]
    documents: list[str] = []
    files: list[tuple[str, Union[str, bytes]]] = []
    for number, one in enumerate(data, 1):
        text: Union[str, bytes]
        if hasattr(one, "to_csv"):
            name, text = f"frame {number}", one.to_csv(index=False)
        elif isinstance(one, Mapping):
            name, text = str(one.get("name", f"measurement {number}")), encode(one)
        else:
            name, text = pathlib.Path(one).name, read_bytes(one)
        files.append((name, text))
        if text.lstrip()[:1] in ("{", "[", b"{", b"["):
            documents.append(_decoded(text, name))
        elif rig is None:
            raise InputError([("rig", "is required with a table: a dict or JSON file that describes the rig")])
        else:
            documents.append(_core.measurement_from_csv(text, _rig_of_table(rig, table)))
    return documents, files


def with_holdout(documents: list[str], holdout: Sequence[str]) -> list[str]:
    """The first document names the runs that no fit may see."""
    if not holdout:
        return documents
    return [encode({**json.loads(documents[0]), "holdout": list(holdout)}), *documents[1:]]


def diagnose(data: Measured, rig: Optional[Source] = None, *, table: Optional[Mapping[str, Any]] = None,
             holdout: Sequence[str] = (), model: str = "", time_limit_s: float = 60.0,
             catalog: Catalog = None, progress: Progress = None) -> Diagnosis:
    """What the model lacks against measured pressures.

    data, rig and table: as for measurements(). holdout: runs that no fit may see. model: predict with this saved model,
    without a fit. The answer's "revision" is what Catalogue.save_model keeps for later designs.
    """
    documents, files = measurements(data, rig, table)
    with _watched(progress) as hear:
        text = _core.diagnose(with_holdout(documents, holdout), locate(catalog), model, time_limit_s, files, hear)
    return Diagnosis(json.loads(text))


def verify(answer: Source, *, brute_force: bool = False, catalog: Catalog = None,
           progress: Progress = None) -> Verification:
    """Checks an answer of design() from scratch, by other code; true where it was accepted."""
    with _watched(progress) as hear:
        return Verification(json.loads(_core.verify(text_of(answer), locate(catalog), brute_force, hear)))
