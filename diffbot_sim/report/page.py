"""report.html: one file that needs no network."""

import json
from dataclasses import dataclass
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from diffbot_sim.identification.result import Comparison, Identification
from diffbot_sim.report import figures, rows, sentences
from diffbot_sim.report.assumptions import assumptions
from diffbot_sim.report.drawing import COLOURS, Figure
from diffbot_sim.report.errors import (
    LABELS,
    MODELS,
    error_rows,
    horizon_rows,
    models_shown,
    run_errors,
)
from diffbot_sim.report.floor import floor_figures
from diffbot_sim.report.numerals import significant
from diffbot_sim.report.origin import Origin
from diffbot_sim.report.spectra import spectrum_figures


@dataclass(frozen=True)
class RunPart:
    """What the page shows of one held-out stretch."""

    name: str
    span: str
    errors: list[tuple[str, str]]
    figures: list[Figure]


def page_text(result: Identification, origin: Origin) -> str:
    """Render the whole page."""
    return (
        _environment()
        .get_template('page.html.j2')
        .render(
            result=result,
            origin=origin.words,
            verdict=sentences.verdict(result),
            split=sentences.split(result.errors),
            errors=error_rows(result.errors),
            horizons=horizon_rows(result),
            models=[(key, LABELS[key]) for key in models_shown(result)],
            checks=[rows.run_row(run) for run in result.runs],
            of_declared=sentences.of_declared(result),
            disagreements=sentences.disagreements(result.runs),
            error_figures=figures.error_figures(result.errors),
            effects=[rows.effect_row(effect) for effect in result.effects],
            structure=result.unexplained and figures.structure_figure(result.unexplained),
            floor=floor_figures(result),
            strength=result.unexplained and sentences.structure(result.unexplained),
            runs=[_run_part(result, run) for run in result.comparisons],
            dependence=figures.residual_figures(result) if result.comparisons else [],
            disturbance=figures.disturbance_figures(result) if result.comparisons else [],
            spectra=spectrum_figures(result.comparisons) if result.comparisons else [],
            empirical=sentences.empirical(result),
            nominal=rows.nominal_rows(result),
            kept=rows.kept_rows(result),
            candidates=[rows.candidate_row(candidate) for candidate in result.candidates],
            ranking=figures.candidates_figure(result),
            assumptions=assumptions(result, origin.notes),
            colours=COLOURS,
            labels=[LABELS[key] for key in MODELS],
            plotly=Markup(get_plotlyjs()),
        )
    )


def _environment() -> Environment:
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(number=significant, drawn=_drawn)
    return environment


def _run_part(result: Identification, run: Comparison) -> RunPart:
    span = f'{run.time[0]:.1f} to {run.time[-1]:.1f} s' if len(run.time) else 'no samples'
    errors = [
        (significant(1e3 * norm['v_rmse']), significant(1e3 * norm['omega_rmse']))
        for norm in run_errors(run).values()
    ]
    return RunPart(run.run, span, errors, figures.run_figures(result, run))


def _drawn(figure: Figure) -> Markup:
    """Write what plotly.js draws as JSON that cannot end its script element."""
    text = json.dumps({'data': figure.data, 'layout': figure.layout}, allow_nan=False)
    return Markup(text.replace('<', '\\u003c'))
