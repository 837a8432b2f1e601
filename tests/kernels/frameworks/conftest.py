import pytest

from holdfast import arms


@pytest.fixture(scope="session")
def panda():
    return arms.load("panda")
