"""What lets an effect in."""

from diffbot_sim.identification.evidence import Evidence
from diffbot_sim.identification.trials import SUPPORTED, judge

CLEAR = Evidence(60.0, 1e-15, 0.004, 0.05, 0.001)


def test_effect_with_all_evidence_enters() -> None:
    assert judge(CLEAR, tried=16) == SUPPORTED


def test_best_of_many_shapes_must_be_surer() -> None:
    assert judge(CLEAR.of_best(40), tried=16) == 'not beyond a disturbance that changes slowly'


def test_effect_that_does_not_predict_held_out_data_stays_outside() -> None:
    vague = Evidence(60.0, 1e-15, 0.004, 0.05, 0.4)
    assert judge(vague, tried=16) == 'does not predict held-out data better'
