/** See afterCurves.ts. */

import "../../ui/mantine.css";

export { FrequencyPart, FuzzyPart, InstantPart } from "./Panels";
export { CarView } from "../../features/car/CarView";
export { DropFiles } from "../../features/library/OpenFiles";
export { RequirementsCard } from "../../features/requirements/RequirementsCard";
export { SharedBanner } from "../../features/share/SharedBanner";
export { Tables } from "../../features/tables/Tables";
export { EditorPane } from "./EditorPane";
export { LabActions, LabTools } from "./LabTools";
export { StageLegend, Toolbar } from "./Toolbar";
export { ChangeChips, VerdictLine } from "../../features/verdict/VerdictLine";
