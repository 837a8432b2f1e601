"""Public robot files, read by holdfast and compared with Pinocchio and MuJoCo."""
