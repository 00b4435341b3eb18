"""The same functions, computed by a service (`plenum serve`). Only the standard library speaks to it."""
from __future__ import annotations

import json
import time
import urllib.error
import urllib.parse
import urllib.request
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Optional, Sequence, Union

from .answers import Designs, Diagnosis, Evaluation, Map, Protocol, Response, SweepTable, answer_of
from .catalogue import frame_of
from .documents import Source, document_of, encode, text_of
from .errors import InputError, ServiceError
from .local import Measured, measurements, with_holdout, with_ranking
from .progress import Progress, listener

if TYPE_CHECKING:
    import pandas as pd

POLL_S = 0.2
WAIT_S = 2  # of the first request, so that short work takes one


class Service:
    """A service by address; `token` where it asks for one."""

    def __init__(self, url: str, token: Optional[str] = None, timeout_s: float = 60.0):
        self.url = url.rstrip("/")
        self._token, self._timeout_s = token, timeout_s

    def __repr__(self) -> str:
        return f"Service({self.url!r})"

    def design(self, requirements: Source, *, top: Optional[int] = None, time_limit_s: Optional[float] = None,
               proof: bool = False, progress: Progress = None) -> Designs:
        """As plenum.design; Ctrl-C cancels the job."""
        request = with_ranking(document_of(requirements), top, time_limit_s, proof)
        return Designs(self._job("/v1/designs", encode(request), progress))

    def diagnose(self, data: Measured, rig: Optional[Source] = None, *, table: Optional[Mapping[str, Any]] = None,
                 holdout: Sequence[str] = (), model: str = "", time_limit_s: float = 60.0, save: str = "",
                 save_part: str = "", specimen: str = "", save_part_anyway: bool = False,
                 progress: Progress = None) -> Diagnosis:
        """As plenum.diagnose, of one document or table. save: the name under which the service keeps the model.
        save_part: the part whose measured numbers it writes, told in "saved_part"; specimen and save_part_anyway as
        for Catalogue.save_part.
        """
        documents, _ = measurements(data, rig, table)
        if len(documents) != 1:
            raise InputError([("data", "a service takes one measurement; join the runs in one document")])
        request = json.loads(with_holdout(documents, holdout)[0])
        request["time_limit_s"] = time_limit_s
        request.update({name: value for name, value in (("model", model), ("save", save), ("save_part", save_part),
                                                        ("save_part_specimen", specimen),
                                                        ("save_part_anyway", save_part_anyway)) if value})
        return Diagnosis(self._job("/v1/diagnoses", encode(request), progress))

    def sweep(self, request: Source, *, progress: Progress = None) -> SweepTable:
        """As plenum.sweep; Ctrl-C cancels what has not ended."""
        hear, close = listener(progress)
        answer = self._post("/v1/sweeps", text_of(request), {"Prefer": f"wait={WAIT_S}"})
        try:
            if "schema" in answer:
                return SweepTable(answer)
            links = answer["links"]
            try:
                while True:
                    sweep = self._get(links["self"])
                    if sweep["ended_at"]:
                        return SweepTable(self._get(links["table"]))
                    if hear is not None:
                        jobs = sweep["jobs"]
                        waits = jobs["queued"] + jobs["running"]
                        hear(json.dumps({"done": sum(jobs.values()) - waits, "of": sum(jobs.values())}))
                    time.sleep(POLL_S)
            except BaseException:
                self._send("DELETE", links["self"])
                raise
        finally:
            close()

    def evaluate(self, request: Source) -> Evaluation:
        return Evaluation(self._post("/v1/evaluations", text_of(request)))

    def simulate(self, request: Source) -> Response:
        return answer_of(self._post("/v1/simulations", text_of(request)))

    def protocol(self, part: str, **sensor: float) -> Protocol:
        """As plenum.protocol."""
        path = f"/v1/parts/{urllib.parse.quote(part, safe='')}/protocol"
        return Protocol(self._get(path + ("?" + urllib.parse.urlencode(sensor) if sensor else "")))

    def simulate_many(self, requests: Iterable[Source]) -> list[Union[Response, InputError]]:
        """One after the other. A request that is refused has its InputError in its place."""
        answers: list[Union[Response, InputError]] = []
        for request in requests:
            try:
                answers.append(self.simulate(request))
            except InputError as error:
                answers.append(error)
        return answers

    def map(self, request: Source) -> Map:
        return Map(self._post("/v1/maps", text_of(request)))

    def parts(self, family: Optional[str] = None, **query: Any) -> "pd.DataFrame":
        """Parts of a family; query: as GET /v1/parts takes it (q, sort, mass_kg_max, …)."""
        fields: dict[str, Any] = {"limit": 1000, **({"family": family} if family else {}), **query}
        parts: list[dict[str, Any]] = []
        while True:
            page = self._get("/v1/parts?" + urllib.parse.urlencode(fields))
            parts += page["parts"]
            if not page.get("next_cursor") or "limit" in query:
                return frame_of(parts)
            fields["cursor"] = page["next_cursor"]

    def _job(self, path: str, text: str, progress: Progress) -> dict[str, Any]:
        """The result of a job, however long it takes; an exception cancels it."""
        hear, close = listener(progress)
        answer = self._post(path, text, {"Prefer": f"wait={WAIT_S}"})
        if "schema" in answer:
            close()
            return answer
        self_path = answer["links"]["self"]
        try:
            while True:
                job = self._get(self_path)
                if job["status"] not in ("queued", "running"):
                    return self._result(job)
                if hear is not None and job.get("progress"):
                    hear(json.dumps(job["progress"]))
                time.sleep(POLL_S)
        except BaseException:
            self._send("DELETE", self_path)
            raise
        finally:
            close()

    @staticmethod
    def _result(job: dict[str, Any]) -> dict[str, Any]:
        if job.get("result") is None:
            raise ServiceError(job.get("detail") or f"the job is {job['status']}, without a result")
        return job["result"]

    def _get(self, path: str) -> dict[str, Any]:
        return self._send("GET", path)

    def _post(self, path: str, text: str, headers: Optional[dict[str, str]] = None) -> dict[str, Any]:
        return self._send("POST", path, text.encode(), headers or {})

    def _send(self, method: str, path: str, body: Optional[bytes] = None,
              headers: Optional[dict[str, str]] = None) -> dict[str, Any]:
        request = urllib.request.Request(self.url + path, data=body, method=method, headers=dict(headers or {}))
        if body is not None:
            request.add_header("Content-Type", "application/json")
        if self._token:
            request.add_header("Authorization", f"Bearer {self._token}")
        try:
            with urllib.request.urlopen(request, timeout=self._timeout_s) as reply:
                return json.loads(reply.read() or b"{}")
        except urllib.error.HTTPError as error:
            raise _refusal(error) from None
        except (OSError, json.JSONDecodeError) as error:
            raise ServiceError(f"{self.url}: {error}") from error


def _refusal(error: urllib.error.HTTPError) -> Exception:
    """A problem document (RFC 9457) as an exception."""
    try:
        problem = json.loads(error.read())
    except json.JSONDecodeError:
        problem = {}
    found = problem.get("errors") or []
    if error.code in (400, 422) and found:
        return InputError([(one.get("pointer", ""), one.get("detail", "")) for one in found])
    return ServiceError(problem.get("detail") or f"HTTP {error.code} {error.reason}", error.code)


def connect(url: str, token: Optional[str] = None) -> Service:
    """The functions of plenum at a service: plenum.connect("http://127.0.0.1:8080").design(…)."""
    return Service(url, token)
