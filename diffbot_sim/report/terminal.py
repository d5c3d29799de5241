"""The summary in the terminal: the report in brief, plain where it is not a terminal."""

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from diffbot_sim.identification.result import Identification
from diffbot_sim.report import sentences
from diffbot_sim.report.errors import LABELS, error_rows, horizon_rows, models_shown
from diffbot_sim.report.numerals import significant
from diffbot_sim.report.remarks import remarks
from diffbot_sim.report.rows import candidate_row, effect_row

TOP = 5
VERDICT_COLOURS = {'nothing_missing': 'green', 'effects_found': 'cyan', 'unexplained': 'yellow'}


def print_summary(result: Identification, console: Console | None = None) -> None:
    """Print the verdict and the tables of errors, effects and best candidates."""
    console = console or Console(highlight=False)
    style = f'bold {VERDICT_COLOURS.get(result.verdict, "")}'
    console.print(Text(sentences.verdict(result), style=style), '')
    for told in (
        sentences.of_declared(result),
        sentences.disagreements(result.runs),
        remarks(result),
    ):
        for sentence in told:
            console.print(Text(sentence, style='yellow'), '')
    console.print(_errors(result))
    if result.horizons:
        console.print(_horizons(result))
    if result.effects:
        console.print(_effects(result))
    if result.unexplained:
        console.print(Text(sentences.empirical(result)), '')
    for effect in result.effects:
        if effect.alternatives:
            console.print(Text(sentences.alternatives(effect)), '')
    if result.candidates:
        console.print(_candidates(result))
    for advice in result.advice:
        console.print(Text(f'Next: {advice}'))


def _errors(result: Identification) -> Table:
    title = 'Free-running error on held-out data'
    table = _table(title, 'model', '>v [mm/s]', '>ω [mrad/s]', '>v, ω over noise floor')
    for row in error_rows(result.errors):
        ratios = f'{significant(row.v_ratio)}, {significant(row.omega_ratio)}'
        table.add_row(row.label, significant(row.v), significant(row.omega), ratios)
    return table


def _horizons(result: Identification) -> Table:
    models = [f'>{LABELS[model]}' for model in models_shown(result)]
    table = _table('Error so far ahead: v [mm/s], ω [mrad/s]', 'ahead', *models)
    for row in horizon_rows(result)[:-1]:  # the last, free-running, is in the table of errors
        pairs = zip(row.v, row.omega, strict=True)
        table.add_row(row.name, *(f'{significant(v)}, {significant(w)}' for v, w in pairs))
    return table


def _effects(result: Identification) -> Table:
    table = _table('Effects found', 'effect', 'parameter', '>value, 95 % interval')
    for effect in map(effect_row, result.effects):
        names = [effect.name] + [''] * (len(effect.parameters) - 1)
        for name, parameter in zip(names, effect.parameters, strict=False):
            table.add_row(Text(name), Text(parameter.name), Text(parameter.value))
    return table


def _candidates(result: Identification) -> Table:
    table = _table('Best candidates', 'effect', '>BIC falls by', '>p, robust', 'outcome')
    for row in map(candidate_row, result.candidates[:TOP]):
        table.add_row(Text(row.name), row.score, row.p_block, Text(row.outcome))
    return table


def _table(title: str, *columns: str) -> Table:
    """Make a table; a column that starts with '>' is set to the right."""
    table = Table(title=Text(title), box=box.SIMPLE_HEAD, title_justify='left', title_style='bold')
    for name in columns:
        text = Text(name.removeprefix('>'))  # as Text, since rich takes [mm/s] for a style
        if name.startswith('>'):
            table.add_column(text, justify='right', no_wrap=True)
        else:
            table.add_column(text, no_wrap=name != 'outcome', overflow='fold')
    return table
