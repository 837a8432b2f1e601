"""Which arm to build: designs that keep what a failure leaves."""
