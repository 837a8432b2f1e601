/** Starts the page of an arm. */

import { ArmPage, startArms } from "./arm_page";
import { STEP_CLASSES } from "./steps";

startArms(ArmPage, STEP_CLASSES);
performance.mark("arm page ready"); // a drag can begin; benchmarks/arm_page.py reads this time
