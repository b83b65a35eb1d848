/** The shapes of the HTTP contract that the page uses: names for what the backend's OpenAPI says. */

import type { Series } from "./decode";
import type { components } from "./schema.gen";

type Schemas = components["schemas"];

type Deep<T> = T extends readonly (infer Item)[]
  ? readonly Deep<Item>[]
  : T extends object
    ? { readonly [Key in keyof T]: Deep<T[Key]> }
    : T;

export type StrategyId = string;
export type SignalKey = string;

export type JsonValue = string | number | boolean | null | readonly JsonValue[] | { readonly [key: string]: JsonValue };
export type JsonObject = Readonly<Record<string, JsonValue>>;

/**
 * A whole scenario. The form is made from its schema at run time and reaches every field by its path, so the page
 * treats it as plain JSON; a field added to the core appears here without a change.
 */
export type Scenario = JsonObject;

export type Quantity = Deep<Schemas["QuantityAnswer"]>;
export type Catalogue = Deep<Schemas["Catalogue"]>;
export type Strategy = Deep<Schemas["StrategyAnswer"]>;
export type Preset = Deep<Omit<Schemas["PresetAnswer"], "scenario">> & { readonly scenario: Scenario };
export type MeasuredRoad = Deep<Schemas["RoadAnswer"]>;
export type CreatedRoad = Deep<Schemas["CreatedRoad"]>;
/** A vehicle with its sources; its values are plain JSON, as the scenario's. */
export type VehiclePreset = Deep<Omit<Schemas["VehicleAnswer"], "vehicle">> & { readonly vehicle: JsonObject };

/** One strategy's figures; `cached` only where the answer is to a request that could have computed it. */
export type Summary = Deep<Schemas["StrategyResult"]> & { readonly cached?: boolean };
export type Failure = Deep<Schemas["StrategyFailure"]> & { readonly cached?: boolean };

interface RunBase {
  readonly core_version: string;
  readonly scenario: Scenario;
}

/** A run of one road, as the service answers it. */
export interface RunAnswer extends RunBase {
  readonly id: string;
  readonly strategies: Readonly<Record<StrategyId, Summary | Failure>>;
}

/** A mean over roads, or a change of means in percent, with its 95 % interval. */
export type Interval = Deep<Schemas["Interval"]>;
type RoadsSummary = Deep<Schemas["RoadsResult"]> & { readonly cached?: boolean };

/** A run over several roads, as the service answers it. */
export interface RoadsAnswer extends RunBase, Pick<OverRoads, "roads" | "baseline" | "changes"> {
  readonly id: string;
  readonly strategies: Readonly<Record<StrategyId, RoadsSummary | Failure>>;
}

/** What several roads say of a run. */
export interface OverRoads {
  readonly roads: number;
  readonly baseline: StrategyId;
  /** Paired, against the baseline. */
  readonly changes: Readonly<Record<StrategyId, Deep<Schemas["StrategyChanges"]>>>;
  readonly estimates: Readonly<Record<StrategyId, Pick<RoadsSummary, "metrics" | "comfort">>>;
}

/** A run as the page has it: over several roads its numbers are the means. */
export interface Run extends RunAnswer {
  readonly over: OverRoads | null;
}

/** What `/solve` is asked beside scenario and roads. */
export interface Question {
  readonly field: string;
  readonly strategy: StrategyId;
  readonly metric: string;
  readonly range: readonly [number, number];
  readonly limit: number;
}
export type Solution = Deep<Schemas["Solution"]>;

export interface LiveAnswer extends RunBase {
  readonly strategies: Readonly<Record<StrategyId, Deep<Schemas["LiveResult"]> | Failure>>;
}

/** How a shared result is looked at; what is left out is as the page opens it. */
export type SharedView = Deep<Omit<Schemas["LinkView"], "strategies" | "hidden" | "baseline">> & {
  readonly strategies?: readonly StrategyId[] | null;
  readonly hidden?: readonly StrategyId[] | null;
  readonly baseline?: StrategyId | null;
};
export type NewLink = Deep<Schemas["CreatedLink"]>;

export type Batch = Deep<Omit<Schemas["Batch"], "scenario">> & { readonly scenario: Scenario };
export type BatchItem = Deep<Omit<Schemas["BatchItem"], "scenario">> & { readonly scenario: Scenario };
export type BatchTable = Deep<Schemas["BatchTable"]>;
export type BatchSummary = Deep<Schemas["BatchSummary"]>;
export type RobustnessDefaults = Deep<Schemas["RobustnessDefaults"]>;
export type Estimate = Deep<Schemas["Estimate"]>;
export type Sweep = Deep<Schemas["Sweep"]>;

export type Tuning = Deep<Omit<Schemas["Tuning"], "scenario">> & { readonly scenario: Scenario };
export type TuningItem = Deep<Schemas["TuningItem"]>;
export type TuningEstimate = Deep<Schemas["TuningEstimate"]>;
export type Objective = Deep<Schemas["ObjectiveAnswer"]>;
export type Limit = Deep<Schemas["LimitAnswer"]>;
/** A set of weights that was tried, and what it gave. */
export type Trial = Deep<Schemas["Trial"]>;
export type Weights = Trial["weights"];
export type Generation = Deep<Schemas["Generation"]>;
export type Comparison = Deep<Schemas["Comparison"]>;
export type ComparedPoint = Deep<Schemas["ComparedPoint"]>;
export type TunedFigure = Deep<Schemas["TunedFigures"]>;

export type ControllerReport = Deep<Schemas["ControllerReport"]>;
export type RealtimeReport = Deep<Schemas["RealtimeReport"]>;
/** Times with their histogram. */
export type Times = RealtimeReport["wake_up"];

export type LinkAnswer = Deep<Omit<Schemas["Link"], "run" | "batch" | "scenario" | "view">> & {
  readonly view: SharedView;
  readonly scenario: Scenario;
  readonly run: RunAnswer | RoadsAnswer | null;
  readonly batch: Batch | null;
};
export type Link = Omit<LinkAnswer, "run"> & { readonly run: Run | null };

/** The paper, checked. */
export type Paper = Deep<Omit<Schemas["PaperAnswer"], "scenario">> & { readonly scenario: Scenario };
export type PaperCell = Paper["cells"][number];
export type PaperReading = Paper["readings"][number];
export type PaperInterpretation = Paper["interpretations"][number];
export type PaperTable = Paper["tables"][number];
export type VerdictCounts = Paper["counts"];
/** Those that are counted; a cell may be pending or unavailable instead. */
export type PaperVerdict = keyof VerdictCounts;
export type PaperJudgement = Deep<Schemas["Judgement"]>;
export type ReadingEffects = Deep<Schemas["ReadingsAnswer"]>;
export type Attribution = Deep<Schemas["AttributionAnswer"]>;
export type Combination = Attribution["rows"][number];
export type PaperFigure = Deep<Omit<Schemas["PaperFigure"], "figure">> & { readonly figure: MadeFigure };

export type EncodedSeries = Readonly<Record<SignalKey, Deep<Schemas["TypedArray"]>>>;
/**
 * Over several roads a signal's samples are the means, and under two names of their own stand the smallest and the largest
 * values of all roads.
 */
export type SeriesByStrategy = Readonly<Record<StrategyId, Series>>;
export type EncodedBand = Readonly<Record<"mean" | "minimum" | "maximum", EncodedSeries>>;

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

/** What a figure template says about itself (`layout.meta`, written by backend/figures.py). */
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
