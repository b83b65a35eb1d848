/** The parts of the lab that are fetched, as one file, once the first curves stand. */

import { lazy } from "react";
import { firstCurves } from "../../lib/firstCurves";

const parts = () => firstCurves.then(() => import("./parts"));

export const CarView = lazy(async () => ({ default: (await parts()).CarView }));
export const DropFiles = lazy(async () => ({ default: (await parts()).DropFiles }));
export const EditorPane = lazy(async () => ({ default: (await parts()).EditorPane }));
export const FrequencyPart = lazy(async () => ({ default: (await parts()).FrequencyPart }));
export const FuzzyPart = lazy(async () => ({ default: (await parts()).FuzzyPart }));
export const InstantPart = lazy(async () => ({ default: (await parts()).InstantPart }));
export const LabActions = lazy(async () => ({ default: (await parts()).LabActions }));
export const LabTools = lazy(async () => ({ default: (await parts()).LabTools }));
export const RequirementsCard = lazy(async () => ({ default: (await parts()).RequirementsCard }));
export const SharedBanner = lazy(async () => ({ default: (await parts()).SharedBanner }));
export const StageLegend = lazy(async () => ({ default: (await parts()).StageLegend }));
export const Tables = lazy(async () => ({ default: (await parts()).Tables }));
export const Toolbar = lazy(async () => ({ default: (await parts()).Toolbar }));
export const ChangeChips = lazy(async () => ({ default: (await parts()).ChangeChips }));
export const VerdictLine = lazy(async () => ({ default: (await parts()).VerdictLine }));
