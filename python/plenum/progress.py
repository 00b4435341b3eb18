"""Progress of long work: a bar on the terminal, or any function of yours."""
from __future__ import annotations

import json
import sys
from typing import Any, Callable, Optional, Union

Progress = Union[None, bool, Callable[[dict[str, Any]], None]]


def words(news: dict[str, Any]) -> str:
    """One line for a person."""
    if "share" in news:
        return f"{100 * news['share']:3.0f} %  {news['doing']}"
    if "done" in news:
        return f"{news['done']} of {news['of']}"
    line = f"{news.get('seconds') or 0.0:.1f} s, {news.get('evaluated', 0)} evaluated"
    best, bound = news.get("best"), news.get("lower_bound")
    if best is not None:
        line += f", best {best:.4g}"
    if bound is not None:
        line += f", no other below {bound:.4g}"
    return line


class Bar:
    """One line on standard error, written over and over."""

    def __init__(self) -> None:
        self._shown = False

    def __call__(self, news: dict[str, Any]) -> None:
        sys.stderr.write("\r\x1b[K" + words(news))
        sys.stderr.flush()
        self._shown = True

    def close(self) -> None:
        if self._shown:
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()


def listener(progress: Progress) -> tuple[Optional[Callable[[str], None]], Callable[[], None]]:
    """What hears the news (JSON text), and what is called at the end."""
    if progress is None:
        progress = sys.stderr.isatty()
    if progress is False:
        return None, lambda: None
    if progress is True:
        bar = Bar()
        return lambda news: bar(json.loads(news)), bar.close
    call = progress
    return lambda news: call(json.loads(news)), lambda: None
