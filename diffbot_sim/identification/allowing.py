"""Friction near rest is allowed for before anything is unexplained: what stands beside it."""

from dataclasses import replace

from diffbot_sim.identification.doubt import Doubted, Seen, doubt, with_friction_eased
from diffbot_sim.identification.found import Found
from diffbot_sim.identification.suspicion import SUSPICIOUS


def allowing_friction(found: Found) -> Found:
    """Doubt all names once more with friction near rest allowed for; take that if it tells more.

    It does where nothing is unexplained any more, or where names stand that had gone for the
    form of that friction.
    """
    eased = _eased(found)
    if eased is None or _excuses_nothing(eased, found):
        return found
    doubted = doubt(eased, with_friction_eased)
    tells_more = excuses(doubted, found) or gives_back(doubted, found)
    return replace(found, **doubted._asdict()) if tells_more else found


def _eased(found: Found) -> Seen | None:
    """Look at what was found with friction near rest allowed for; None where that is nothing.

    Where it is nothing, neither beside all names nor beside those that stood, doubt is as it was.
    """
    seen = with_friction_eased(found.undoubted, found.held_out)
    if not seen.strict and found.selection is not found.undoubted:
        stood = with_friction_eased(found.selection, found.held_out)
        return seen if stood.strict else None
    return seen if seen.strict else None


def _excuses_nothing(eased: Seen, found: Found) -> bool:
    """Say whether doubt need not be asked: without names it leaves what is allowed for."""
    return not eased.selection.support and eased.near_rest <= _least(found)


def excuses(doubted: Doubted, found: Found) -> bool:
    """Say whether what was unexplained is friction near rest.

    What chance could allow for excuses nothing, nor does what leaves something else to be told.
    Nor is excused what is worth more, less what names explain of it that stand only then.
    """
    support = doubted.selection.support
    only_then = sum(support[name].delta_bic for name in support.keys() - found.names)
    return doubted.unexplained is None and doubted.near_rest > _least(found, only_then)


def gives_back(doubted: Doubted, found: Found) -> bool:
    """Say whether names stand beside friction near rest that went for its form.

    A free form of the speed is both at once, the form of that friction and what a name explains,
    and so explains more than the name. With all names that stood before, less must be left.
    """
    stand, left = doubted.selection.support.keys(), doubted.unexplained
    less = left is not None and left.worth < _worth(found)
    return less and stand > found.names and doubted.near_rest > SUSPICIOUS


def _least(found: Found, only_then: float = 0.0) -> float:
    """Return by how much what is allowed for must lower the deviance to excuse anything.

    only_then: worth of names that stand only beside it.
    """
    return max(SUSPICIOUS, _worth(found) - only_then)


def _worth(found: Found) -> float:
    return found.unexplained.worth if found.unexplained else 0.0
