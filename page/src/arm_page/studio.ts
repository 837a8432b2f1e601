/** Starts the page of the studio. */

import { startArms } from "./start_arms";
import { StudioPage } from "./studio_page";
import { STUDIO_STEPS } from "./studio_steps";

startArms(StudioPage, STUDIO_STEPS);
