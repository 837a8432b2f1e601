/** Starts the page of the studio. */

import { startArms } from "./arm_page";
import { StudioPage } from "./studio_page";
import { STUDIO_STEPS } from "./studio_steps";

startArms(StudioPage, STUDIO_STEPS);
