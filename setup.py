"""Install the modules, the shared files and one executable per command."""

from glob import glob

from setuptools import find_packages, setup

NAME = 'diffbot_sim'
COMMANDS = ['simulator', 'pi_controller', 'driver', 'recorder', 'replay']
COMMANDS += ['simulate', 'identify', 'recover', 'paper', 'demo']

setup(
    name=NAME,
    version='0.1.0',
    description='Differential-drive simulation with real friction, and its identification',
    author='diffbot_sim maintainers',
    author_email='maintainers@example.org',
    maintainer='diffbot_sim maintainers',
    maintainer_email='maintainers@example.org',
    license='Apache-2.0',
    python_requires='>=3.10',
    packages=find_packages(include=[NAME, f'{NAME}.*']),
    package_data={
        NAME: [
            'py.typed',
            *(f'report/*.{kind}' for kind in ('html', 'css', 'j2')),
            *(f'paper/*.{kind}' for kind in ('yaml', 'j2', 'mplstyle')),
        ],
    },
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{NAME}']),
        (f'share/{NAME}', ['package.xml']),
        (f'share/{NAME}/launch', glob('launch/*.py')),
        (f'share/{NAME}/config', glob('config/*')),
        (f'share/{NAME}/urdf', glob('urdf/*')),
    ],
    # rclpy and the messages come with ROS, or from requirements.lock where there is none.
    install_requires=[
        'jinja2',
        'matplotlib',
        'mcap',
        'numba',
        'numpy',
        'plotly',
        'pyarrow',
        'PyYAML',
        'rich',
        'rosbags',
        'scipy',
    ],
    extras_require={'test': ['pytest', 'pytest-timeout', 'pytest-xdist', 'hypothesis', 'mujoco']},
    entry_points={
        'console_scripts': [f'{name} = {NAME}.entry_points:{name}' for name in COMMANDS],
    },
    zip_safe=True,
)
