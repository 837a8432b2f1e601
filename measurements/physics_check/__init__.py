"""Does the kinematic picture of an arm with an unnoticed lock hold? Its motions once with bodies and motors."""
