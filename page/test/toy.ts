import type { Arm } from "../src/arm";

/** Two prismatic joints, along x and y: the end effector is where the joints are. Law 1 answers with half of the command. */
export const slides: Arm = {
  joints: 2,
  axes: 2,
  laws: 2,
  markers: 2,
  cycle(law, q, velocity, healthy, out) {
    for (let i = 0; i < 2; i++) {
      const rate = (healthy[i] * velocity[i]) / (1 + law);
      out[i] = q[i] + rate;
      out[2 + i] = rate;
    }
  },
  position(q, out) {
    out.set(q);
  },
  points(q, out) {
    out.set([0, 0, 0, q[0], q[1], 0]);
  },
};
