"""Quality of service, as bags tell it and as rclpy wants it."""

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from diffbot_sim.bags.raw import Offer


def profile(offer: Offer, depth: int) -> QoSProfile:
    """Return the profile of an offer; depth: messages that may wait."""
    return QoSProfile(
        depth=depth,
        reliability=ReliabilityPolicy[offer.reliability.upper()],
        durability=DurabilityPolicy[offer.durability.upper()],
    )
