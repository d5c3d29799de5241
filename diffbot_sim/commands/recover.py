"""Save what can be read of a bag whose recording was cut off."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from diffbot_sim.bags.recover import Recovery, recover
from diffbot_sim.commands._recordings import check_out, folder


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        'bag', type=Path, metavar='BAG', help='folder of the bag, or its .mcap or .db3 file'
    )
    parser.add_argument(
        '--out', type=folder, required=True, metavar='DIR', help='folder of the new bag'
    )


def run(arguments: Namespace) -> None:
    """Write the new bag and tell what is in it; the old one stays as it is."""
    check_out(arguments.out, [arguments.bag])
    tell(recover(arguments.bag, arguments.out))
    print(f'bag: {arguments.out}')


def tell(recovery: Recovery) -> None:
    """Print what was saved of each topic, and what was not."""
    if recovery.was_whole:
        print('nothing was wrong with this bag; copied as it is')
    width = max(map(len, recovery.saved))
    for topic, saved in sorted(recovery.saved.items()):
        print(f'{topic:{width}} {saved.count:8} messages {saved.seconds:8.1f} s')
    for topic in recovery.left_out:
        print(f'left out {topic}: the bag does not define the type, and it is not known here')
