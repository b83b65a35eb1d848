/** The shapes of the HTTP contract: as the backend's OpenAPI says, and as the page has them. */

import type { Series } from "./decode";
import type { JsonObject, JsonValue } from "./json";
import type {
  Batch as BatchAnswer,
  BatchField,
  BatchItem as BatchItemAnswer,
  CharacteristicsAnswer as Characteristics,
  ComparisonAnswer as Comparison,
  CreatedRoadsRun,
  Link as LinkAnswer,
  PaperAnswer,
  PaperFigure as PaperFigureAnswer,
  RoadsResult,
  RoadsRun,
  SolveRequest,
  StrategyFailure,
  StrategyResult,
  Sweep,
  Trial,
  TuningRequest,
} from "./schema.gen";

export type * from "./json";
export type * from "./schema.gen";
export type {
  AttributionAnswer as Attribution,
  CautionAnswer as Caution,
  CharacteristicsAnswer as Characteristics,
  CombinationRow as Combination,
  ComparisonAnswer as Comparison,
  Counts as VerdictCounts,
  CreatedLink as NewLink,
  Judgement as PaperJudgement,
  LimitAnswer as Limit,
  LinkView as SharedView,
  ObjectiveAnswer as Objective,
  PaperAnswer as Paper,
  PresetAnswer as Preset,
  QuantityAnswer as Quantity,
  ReadingsAnswer as ReadingEffects,
  RoadAnswer as MeasuredRoad,
  StrategyAnswer as Strategy,
  TunedFigures as TunedFigure,
  VehicleAnswer as VehiclePreset,
} from "./schema.gen";

export type StrategyId = string;
export type SignalKey = string;
/** Plain JSON: the form is made from the scenario's schema at run time and reaches every field by its path. */
export type Scenario = JsonObject;

/** One strategy's figures; `cached` only where the answer is to a request that could have computed it. */
export type Summary = StrategyResult & { readonly cached?: boolean };
export type Failure = StrategyFailure & { readonly cached?: boolean };

/** A run of one road, as the service answers it. */
export interface RunAnswer {
  readonly id: string;
  readonly core_version: string;
  readonly scenario: Scenario;
  /** What the vehicle’s values come to; services before core 0.4.0 do not say it. */
  readonly characteristics?: Characteristics;
  /** The comparison of the results; services before core 0.5.0 do not have it. */
  readonly comparison?: Comparison;
  readonly strategies: Readonly<Record<StrategyId, Summary | Failure>>;
}
export type RoadsAnswer = RoadsRun | CreatedRoadsRun;

/** A run that is not stored, with its curves. */
export interface LiveAnswer extends Omit<RunAnswer, "id"> {
  readonly series: SeriesByStrategy;
}

/** What several roads say of a run: the changes are paired, against the baseline. */
export interface OverRoads extends Pick<RoadsRun, "roads" | "baseline" | "changes"> {
  readonly estimates: Readonly<Record<StrategyId, Pick<RoadsResult, "metrics" | "comfort">>>;
}

/** A run as the page has it: over several roads its numbers are the means. */
export interface Run extends RunAnswer {
  readonly over: OverRoads | null;
}
export type Link = Omit<LinkAnswer, "run" | "batch"> & { readonly run: Run | null; readonly batch: Batch | null };

/** Until it is planned a batch has no runs and no fields. */
interface Planned {
  readonly total: number;
  readonly fields: readonly BatchField[];
}
export type BatchItem = Omit<BatchItemAnswer, keyof Planned> & Planned;
/** A batch as the page has it: with its sweep. */
export type Batch = Omit<BatchAnswer, keyof Planned> & Planned & { readonly sweep: Sweep };

/** What `/solve` is asked beside the scenario. */
export type Question = Omit<SolveRequest, "scenario">;
/** What of a tuning is chosen beside its scenario. */
export type TuningChoice = Omit<TuningRequest, "scenario">;
export type Weights = Trial["weights"];

export type PaperCell = PaperAnswer["cells"][number];
export type PaperReading = PaperAnswer["readings"][number];
export type PaperInterpretation = PaperAnswer["interpretations"][number];
export type PaperTable = PaperAnswer["tables"][number];
/** Those that are counted; a cell may be pending or unavailable instead. */
export type PaperVerdict = keyof PaperAnswer["counts"];
export type PaperFigure = Omit<PaperFigureAnswer, "figure"> & { readonly figure: MadeFigure };

/**
 * Over several roads a signal's samples are the means, and under two names of their own stand the smallest and the largest
 * values of all roads.
 */
export type SeriesByStrategy = Readonly<Record<StrategyId, Series>>;

/** A whole plotly figure with its data in it, as the server has made it. */
export interface MadeFigure {
  readonly data: readonly MadeTrace[];
  readonly layout: Readonly<Record<string, unknown>> & { readonly xaxis?: JsonObject; readonly yaxis?: JsonObject };
}

/** plotly reads the encoded numbers itself. */
export interface MadeTrace extends JsonObject {
  readonly type: "scatter";
  readonly name: string;
}

/** What a figure template says about itself (`layout.meta`, written by backend/runs/figures.py). */
export interface FigureMeta {
  readonly title: string;
  readonly unit: string;
  /** Factor from SI to `unit`. */
  readonly scale: number;
  readonly signal: SignalKey;
  /** Its axis spans at least this, in `unit`. */
  readonly least_span: number;
  /** The brakes are on from this pressure [Pa]. */
  readonly braking: number;
  /** Reference lines: each stands at these multiples of its value. */
  readonly reference_factors: Readonly<Record<string, readonly number[]>>;
  readonly reference_labels: Readonly<Record<string, string>>;
  /** Centre and half width of a band, by reference. */
  readonly band: readonly string[] | null;
  /** Titles of the two x axes. */
  readonly axes: Readonly<Record<string, string>>;
  /** What stands behind the curves: a colour for each shaded stage, for a band, for reference lines. */
  readonly stage_fills: Readonly<Record<string, string>>;
  readonly band_fill: string;
  readonly neutral: string;
}

export interface FigureTrace {
  readonly name?: string;
  readonly line?: Readonly<Record<string, JsonValue>>;
  readonly meta: { readonly strategy: StrategyId; readonly signal: SignalKey };
}

export interface FigureTemplate {
  readonly data: readonly FigureTrace[];
  readonly layout: { readonly meta: FigureMeta } & Readonly<Record<string, unknown>>;
}
export type FigureTemplates = Readonly<Record<string, FigureTemplate>>;
