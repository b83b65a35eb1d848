// Generated from the backend's OpenAPI by `npm run api`; do not edit.

import type { JsonObject } from "./json";
export interface paths {
    readonly "/batches": {
        readonly get: operations["listBatches"];
        readonly post: operations["createBatch"];
    };
    readonly "/batches/{id}": {
        readonly get: operations["getBatch"];
        readonly delete: operations["deleteBatch"];
        readonly patch: operations["labelBatch"];
    };
    readonly "/batches/{id}/cancel": {
        readonly post: operations["cancelBatch"];
    };
    readonly "/batches/{id}/events": {
        readonly get: operations["getBatchEvents"];
    };
    readonly "/batches/{id}/requirements": {
        readonly get: operations["getBatchRequirements"];
    };
    readonly "/batches/{id}/results": {
        readonly get: operations["getBatchResults"];
    };
    readonly "/batches/{id}/resume": {
        readonly post: operations["resumeBatch"];
    };
    readonly "/batches/{id}/summary": {
        readonly get: operations["getBatchSummary"];
    };
    readonly "/batches/{id}/sweep": {
        readonly get: operations["getBatchSweep"];
    };
    readonly "/batches/{id}/table": {
        readonly get: operations["getBatchTable"];
    };
    readonly "/catalogue": {
        readonly get: operations["getCatalogue"];
    };
    readonly "/controller": {
        readonly post: operations["exportController"];
    };
    readonly "/controller/compilers": {
        readonly get: operations["getCompilers"];
    };
    readonly "/controller/realtime": {
        readonly post: operations["driveByClock"];
    };
    readonly "/controller/report": {
        readonly post: operations["reportController"];
    };
    readonly "/figures": {
        readonly get: operations["getFigures"];
    };
    readonly "/fmus": {
        readonly post: operations["exportFmu"];
    };
    readonly "/frequency": {
        readonly post: operations["frequency"];
    };
    readonly "/fuzzy": {
        readonly post: operations["fuzzy"];
    };
    readonly "/links": {
        readonly get: operations["listLinks"];
        readonly post: operations["createLink"];
    };
    readonly "/links/{slug}": {
        readonly get: operations["getLink"];
        readonly delete: operations["revokeLink"];
    };
    readonly "/live": {
        readonly post: operations["live"];
    };
    readonly "/login": {
        readonly get: operations["getLogin"];
        readonly post: operations["logIn"];
        readonly delete: operations["logOut"];
    };
    readonly "/paper": {
        readonly get: operations["getPaper"];
    };
    readonly "/paper/attribution": {
        readonly get: operations["getPaperAttribution"];
    };
    readonly "/paper/figures": {
        readonly get: operations["getPaperFigures"];
    };
    readonly "/paper/readings": {
        readonly get: operations["getPaperReadings"];
    };
    readonly "/paper/report.html": {
        readonly get: operations["getPaperReport"];
    };
    readonly "/presets": {
        readonly get: operations["getPresets"];
    };
    readonly "/problems": {
        readonly get: operations["getProblems"];
    };
    readonly "/recordings": {
        readonly get: operations["listRecordings"];
        readonly post: operations["createRecording"];
    };
    readonly "/recordings/{id}": {
        readonly get: operations["getRecording"];
        readonly delete: operations["deleteRecording"];
    };
    readonly "/roads": {
        readonly get: operations["listRoads"];
        readonly post: operations["createRoad"];
    };
    readonly "/roads/{id}": {
        readonly get: operations["getRoad"];
        readonly delete: operations["deleteRoad"];
    };
    readonly "/robustness": {
        readonly get: operations["getRobustnessDefaults"];
    };
    readonly "/runs": {
        readonly post: operations["createRun"];
    };
    readonly "/runs/{id}": {
        readonly get: operations["getRun"];
    };
    readonly "/runs/{id}/bands": {
        readonly get: operations["getBands"];
    };
    readonly "/runs/{id}/changes": {
        readonly get: operations["getChanges"];
    };
    readonly "/runs/{id}/differences": {
        readonly get: operations["getDifferences"];
    };
    readonly "/runs/{id}/figures": {
        readonly get: operations["getRunFigures"];
    };
    readonly "/runs/{id}/figures/{name}": {
        readonly get: operations["getRunFigure"];
    };
    readonly "/runs/{id}/instant": {
        readonly get: operations["getInstant"];
    };
    readonly "/runs/{id}/report.html": {
        readonly get: operations["getRunReport"];
    };
    readonly "/runs/{id}/series": {
        readonly get: operations["getSeries"];
    };
    readonly "/schema": {
        readonly get: operations["getSchema"];
    };
    readonly "/solve": {
        readonly post: operations["solve"];
    };
    readonly "/strategies": {
        readonly get: operations["getStrategies"];
    };
    readonly "/tunings": {
        readonly get: operations["listTunings"];
        readonly post: operations["createTuning"];
    };
    readonly "/tunings/{id}": {
        readonly get: operations["getTuning"];
        readonly delete: operations["deleteTuning"];
        readonly patch: operations["labelTuning"];
    };
    readonly "/tunings/{id}/cancel": {
        readonly post: operations["cancelTuning"];
    };
    readonly "/tunings/{id}/events": {
        readonly get: operations["getTuningEvents"];
    };
    readonly "/tunings/{id}/resume": {
        readonly post: operations["resumeTuning"];
    };
    readonly "/tunings/{id}/trials": {
        readonly get: operations["getTuningTrials"];
    };
    readonly "/vehicles": {
        readonly get: operations["getVehicles"];
    };
    readonly "/vehicles/from-data-sheet": {
        readonly post: operations["makeHalfCar"];
    };
}
export interface components {
    schemas: {
        readonly AbsoluteRow: {
            readonly default: components["schemas"]["OurAbsolute"] | null;
            readonly nearest: components["schemas"]["OurAbsolute"] | null;
            readonly printed: number;
            readonly signal: string;
            readonly statistic: string;
            readonly strategy: string;
            readonly window: string;
        };
        readonly Absolutes: {
            readonly distances: readonly components["schemas"]["Distances"][];
            readonly rows: readonly components["schemas"]["AbsoluteRow"][];
        };
        readonly Agreement: {
            readonly cells: number;
            readonly in_interval: number;
            readonly within: number;
        };
        readonly AttributionAnswer: {
            readonly core_version: string;
            readonly equal_speed: readonly components["schemas"]["EqualSpeed"][];
            readonly first_seed: number;
            readonly rows: readonly components["schemas"]["CombinationRow"][];
            readonly seeds: number;
            readonly sentences: readonly string[];
            readonly shares: readonly components["schemas"]["Share"][];
        };
        readonly AxlesAnswer: {
            readonly front: number;
            readonly rear: number;
        };
        readonly backend__paper__models__TableAnswer: {
            readonly columns: readonly components["schemas"]["Column"][];
            readonly number: number;
            readonly title: string;
        };
        readonly backend__table_models__TableAnswer: {
            readonly bridge: number | null;
            readonly clock: components["schemas"]["TableClock"];
            readonly columns: readonly components["schemas"]["TableColumn"][];
            /** @enum {string} */
            readonly decimal: "." | ",";
            readonly encoding: string;
            readonly first_row: number;
            readonly from: number | null;
            /** @enum {string} */
            readonly kind: "road" | "drive";
            readonly notes: readonly string[];
            readonly preview: readonly (readonly string[])[];
            readonly questions: readonly components["schemas"]["TableQuestion"][];
            readonly separator: string;
            readonly sheet: string | null;
            readonly titles_line: number | null;
            readonly to: number | null;
            readonly units_line: number | null;
        };
        readonly Band: {
            readonly maximum: {
                readonly [key: string]: readonly (number | null)[] | components["schemas"]["TypedArray"];
            };
            readonly mean: {
                readonly [key: string]: readonly (number | null)[] | components["schemas"]["TypedArray"];
            };
            readonly minimum: {
                readonly [key: string]: readonly (number | null)[] | components["schemas"]["TypedArray"];
            };
        };
        readonly Bands: {
            readonly core_version: string;
            readonly roads: number;
            readonly strategies: {
                readonly [key: string]: components["schemas"]["Band"];
            };
            readonly units: {
                readonly [key: string]: string;
            };
        };
        readonly Batch: {
            readonly baseline: string | null;
            readonly core_version: string;
            readonly created_at: string;
            readonly done: number;
            readonly estimated_cost: number | null;
            readonly failed: number;
            readonly fields: readonly components["schemas"]["BatchField"][] | null;
            readonly finished_at: string | null;
            readonly id: string;
            readonly label: string | null;
            readonly position: number;
            readonly problem: components["schemas"]["JobProblem"] | null;
            readonly reason: string | null;
            readonly requirements: readonly components["schemas"]["Requirement"][];
            readonly resumable: boolean;
            readonly scenario: JsonObject;
            readonly started_at: string | null;
            /** @enum {string} */
            readonly state: "planning" | "queued" | "running" | "done" | "cancelled" | "failed";
            readonly strategies: readonly string[];
            readonly total: number | null;
        };
        readonly Batches: {
            readonly batches: readonly components["schemas"]["BatchItem"][];
            readonly next: string | null;
        };
        readonly BatchField: {
            readonly linked_to: string | null;
            readonly name: string;
            readonly title: string;
            readonly unit: string;
        };
        readonly BatchItem: {
            readonly baseline: string | null;
            readonly core_version: string;
            readonly created_at: string;
            readonly done: number;
            readonly estimated_cost: number | null;
            readonly failed: number;
            readonly fields: readonly components["schemas"]["BatchField"][] | null;
            readonly finished_at: string | null;
            readonly id: string;
            readonly label: string | null;
            readonly position: number;
            readonly problem: components["schemas"]["JobProblem"] | null;
            readonly reason: string | null;
            readonly requirements: readonly components["schemas"]["Requirement"][];
            readonly scenario: JsonObject;
            readonly started_at: string | null;
            /** @enum {string} */
            readonly state: "planning" | "queued" | "running" | "done" | "cancelled" | "failed";
            readonly strategies: readonly string[];
            readonly total: number | null;
        };
        readonly BatchRequest: {
            readonly baseline?: string | null;
            readonly dry_run?: boolean;
            readonly label?: string | null;
            readonly requirements?: readonly components["schemas"]["Requirement"][];
            readonly scenario?: JsonObject;
            readonly strategies: readonly string[];
            readonly sweep: components["schemas"]["Sweep"];
        };
        readonly BatchRequirementResult: {
            readonly baseline: string | null;
            readonly counts: {
                readonly [key: string]: number;
            };
            readonly first_failure: components["schemas"]["FailingRun"] | null;
            readonly max: number | null;
            readonly max_change: number | null;
            readonly metric: string;
            readonly min: number | null;
            readonly reason: string | null;
            /** @enum {string} */
            readonly result: "pass" | "fail" | "uncertain";
            readonly strategy: string;
            readonly worst_failure: components["schemas"]["FailingRun"] | null;
        };
        readonly BatchRequirements: {
            readonly batch: string;
            readonly requirement_results: readonly components["schemas"]["BatchRequirementResult"][];
            readonly runs: readonly (("pass" | "fail" | "uncertain") | null)[];
            /** @enum {string} */
            readonly state: "planning" | "queued" | "running" | "done" | "cancelled" | "failed";
        };
        readonly BatchResults: {
            readonly batch: string;
            readonly core_version: string;
            readonly next: number | null;
            readonly rows: readonly components["schemas"]["BatchRow"][];
            readonly scenario: JsonObject;
            readonly sweep: JsonObject;
            readonly units: {
                readonly [key: string]: string;
            };
        };
        readonly BatchRow: {
            readonly fields?: readonly string[] | null;
            readonly kind?: ("refused" | "too-expensive") | null;
            readonly reason?: string | null;
            readonly run: number;
            /** @enum {string} */
            readonly status: "ok" | "failed" | "waiting" | "cancelled";
            readonly strategy: string;
        };
        readonly BatchSummary: {
            readonly baseline: string;
            readonly batch: string;
            readonly core_version: string;
            readonly points: number;
            readonly quantiles: readonly number[];
            /** @enum {string} */
            readonly state: "planning" | "queued" | "running" | "done" | "cancelled" | "failed";
            readonly strategies: {
                readonly [key: string]: components["schemas"]["StrategySummary"];
            };
            readonly units: {
                readonly [key: string]: string;
            };
        };
        readonly BatchTable: {
            readonly batch: string;
            readonly columns: {
                readonly [key: string]: readonly (number | string | boolean | readonly (number | readonly number[])[] | {
                    readonly [key: string]: string;
                } | null)[];
            };
            /** @enum {string} */
            readonly state: "planning" | "queued" | "running" | "done" | "cancelled" | "failed";
            readonly units: {
                readonly [key: string]: string;
            };
        };
        readonly CachedFailure: {
            readonly cached: boolean;
            readonly compute_ms: number;
            readonly fields: readonly string[];
            /** @enum {string} */
            readonly kind: "refused" | "too-expensive" | "unavailable";
            readonly reason: string;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            readonly status: "failed";
        };
        readonly CachedResult: {
            readonly arrival_speed_kmh: number | null;
            readonly cached: boolean;
            readonly comfort: {
                readonly [key: string]: number | null;
            };
            readonly compute_ms: number;
            readonly core_version?: string | null;
            readonly events: {
                readonly [key: string]: boolean | number | null;
            };
            readonly metrics: {
                readonly [key: string]: {
                    readonly [key: string]: components["schemas"]["Statistics"];
                };
            };
            readonly recording?: components["schemas"]["RecordingReport"] | null;
            readonly reference: {
                readonly [key: string]: number | null;
            };
            readonly source: components["schemas"]["Source"] | null;
            readonly stages: readonly components["schemas"]["Stage"][];
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            readonly status: "ok";
            readonly travel_time: number | null;
        };
        readonly CachedRoadsResult: {
            readonly arrival_speed_kmh: number | null;
            readonly cached: boolean;
            readonly comfort: {
                readonly [key: string]: components["schemas"]["Interval"];
            };
            readonly compute_ms: number;
            readonly core_version: string | null;
            readonly events: {
                readonly [key: string]: boolean | number | null;
            };
            readonly metrics: {
                readonly [key: string]: {
                    readonly [key: string]: components["schemas"]["RoadsStatistics"];
                };
            };
            readonly reference: {
                readonly [key: string]: number | null;
            };
            readonly source: components["schemas"]["Source"] | null;
            readonly stages: readonly components["schemas"]["Stage"][];
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            readonly status: "ok";
            readonly travel_time: number | null;
        };
        readonly Catalogue: {
            readonly comfort: readonly components["schemas"]["QuantityAnswer"][];
            readonly events: readonly components["schemas"]["QuantityAnswer"][];
            readonly metric_signals: readonly string[];
            readonly paper_signals: readonly string[];
            readonly references: readonly components["schemas"]["QuantityAnswer"][];
            readonly run_figures: readonly components["schemas"]["QuantityAnswer"][];
            readonly signals: readonly components["schemas"]["QuantityAnswer"][];
            readonly stages: readonly components["schemas"]["QuantityAnswer"][];
            readonly statistics: readonly components["schemas"]["QuantityAnswer"][];
            readonly windows: readonly components["schemas"]["QuantityAnswer"][];
        };
        readonly CautionAnswer: {
            readonly field: string | null;
            readonly kind: string;
            readonly strategy: string | null;
            readonly text: string;
        };
        readonly Cell: {
            readonly against: string;
            readonly certain: boolean | null;
            readonly ci: readonly number[] | null;
            readonly misprint: components["schemas"]["Misprint"] | null;
            readonly our_base: number | null;
            readonly our_change: number | null;
            readonly our_factor: number;
            readonly our_value: number | null;
            readonly paper_base: number;
            readonly paper_change: number;
            readonly paper_value: number;
            readonly signal: string;
            readonly statistic: string;
            readonly strategy: string;
            readonly table: number;
            /** @enum {string} */
            readonly verdict: "reached" | "smaller" | "contradicts" | "unavailable" | "pending";
            readonly window: string;
            readonly without_preview: components["schemas"]["Judgement"] | null;
        };
        readonly Change: {
            readonly ci: readonly number[];
            readonly our_change: number;
            readonly signal: string;
            readonly statistic: string;
            readonly window: string;
        };
        readonly ChangeAnswer: {
            readonly beyond_variation: boolean;
            readonly change: number | null;
            readonly high: number | null;
            readonly low: number | null;
        };
        readonly Changes: {
            readonly peak: components["schemas"]["Interval"] | null;
            readonly rms: components["schemas"]["Interval"] | null;
        };
        readonly CharacteristicsAnswer: {
            readonly damping_ratios: components["schemas"]["ModesAnswer"];
            readonly natural_frequencies: components["schemas"]["ModesAnswer"];
            readonly static_sag: components["schemas"]["AxlesAnswer"];
        };
        readonly Column: {
            readonly against: string;
            readonly strategy: string;
        };
        readonly CombinationRow: {
            readonly comfort: {
                readonly [key: string]: components["schemas"]["Comfort"];
            };
            /** @enum {string} */
            readonly controller: "passive" | "lqr" | "mpc";
            readonly id: string;
            readonly is: string | null;
            readonly label: string;
            readonly metrics: readonly components["schemas"]["Figure8"][];
            readonly preview: ("none" | "wheelbase" | "lookahead") | null;
            /** @enum {string} */
            readonly speed: "constant" | "planned";
            readonly travel_time: number;
            readonly weights: ("equal" | "comfort" | "switched") | null;
        };
        readonly Comfort: {
            readonly high: number;
            readonly low: number;
            readonly value: number;
        };
        readonly ComparedFigure: {
            readonly key: string;
            readonly label: string;
            readonly unit: string;
        };
        readonly ComparedPoint: {
            readonly failures: readonly string[];
            readonly fresh: {
                readonly [key: string]: components["schemas"]["TunedFigures"];
            };
            readonly roles: readonly string[];
            readonly training: {
                readonly [key: string]: components["schemas"]["TunedFigures"];
            };
            readonly trial: number;
            readonly verdict: readonly ("better" | "worse" | "unclear")[] | null;
            readonly weights: {
                readonly [key: string]: number | string | readonly number[];
            };
        };
        readonly ComparisonAnswer: {
            readonly baseline: string;
            readonly cautions: readonly components["schemas"]["CautionAnswer"][];
            readonly changes: {
                readonly [key: string]: {
                    readonly [key: string]: components["schemas"]["ChangeAnswer"];
                };
            };
            readonly changes_against: {
                readonly [key: string]: {
                    readonly [key: string]: components["schemas"]["ChangeAnswer"];
                };
            };
            readonly requirements: readonly components["schemas"]["RequirementResult"][];
            readonly verdict: components["schemas"]["VerdictAnswer"];
        };
        readonly Compilers: {
            readonly report: string | null;
        };
        readonly Condition: {
            readonly distance?: string | null;
            readonly speed_error?: string | null;
        };
        readonly ConditionalReadsAnswer: {
            readonly conditions: readonly components["schemas"]["ConditionAnswer"][];
            readonly fields: readonly string[];
        };
        readonly ConditionAnswer: {
            readonly excluded: boolean;
            readonly field: string;
            readonly values: readonly (string | boolean | number | null)[];
        };
        readonly ControllerLimit: {
            readonly distance: number;
            readonly force_without: readonly number[] | null;
            readonly limit: number;
            readonly multiplier: number | null;
            readonly multipliers: readonly number[] | null;
            readonly name: string;
            readonly unit: string;
            readonly values: readonly number[];
        };
        readonly ControllerPart: {
            readonly clock: number;
            readonly flash: number;
            readonly name: string;
            readonly ram: number;
            readonly stack: number;
        };
        readonly ControllerReport: {
            readonly cycles_per_operation: number;
            readonly part: components["schemas"]["ControllerPart"];
            readonly rows: readonly components["schemas"]["ControllerRow"][];
            readonly sample_time: number;
            readonly spread: number;
        };
        readonly ControllerRequest: {
            readonly scenario?: JsonObject;
        };
        readonly ControllerRow: {
            readonly changes: {
                readonly [key: string]: {
                    readonly [key: string]: number | null;
                };
            };
            /** @enum {string} */
            readonly checked: "all" | "few";
            readonly checked_rows: number;
            readonly code: number;
            readonly constants: number;
            readonly control_horizon: number;
            readonly fits: boolean;
            readonly iterations: number;
            readonly most_iterations: number;
            readonly operations: components["schemas"]["Operations"];
            readonly prediction_horizon: number;
            readonly reasons: readonly string[];
            readonly time: components["schemas"]["StepTime"];
            readonly unfinished: number;
            readonly variables: number;
        };
        readonly Counts: {
            readonly contradicts: number;
            readonly reached: number;
            readonly smaller: number;
        };
        readonly CreatedLink: {
            readonly series_pinned: boolean;
            readonly slug: string;
            readonly url: string;
        };
        readonly CreatedRecording: {
            readonly columns: readonly components["schemas"]["RecordedColumn"][];
            readonly distance: number | null;
            readonly duration: number | null;
            readonly id: string;
            readonly samples: number;
            readonly signals: readonly string[];
            readonly strategy: string;
            readonly warnings: readonly string[];
        };
        readonly CreatedRoad: {
            readonly bumps: readonly components["schemas"]["FoundBumpAnswer"][];
            readonly cautions: readonly components["schemas"]["CautionAnswer"][];
            readonly id: string;
            readonly iri: components["schemas"]["IriAnswer"] | null;
            readonly iso_class: string | null;
            readonly length: number;
            readonly roughness: components["schemas"]["EstimateAnswer"] | null;
            readonly samples: number;
            readonly spectrum: components["schemas"]["SpectrumAnswer"] | null;
            readonly warnings: readonly string[];
            readonly waviness: components["schemas"]["EstimateAnswer"] | null;
        };
        readonly CreatedRoadsRun: {
            readonly baseline: string;
            readonly cautions: readonly components["schemas"]["CautionAnswer"][];
            readonly changes: {
                readonly [key: string]: components["schemas"]["StrategyChanges"];
            };
            readonly characteristics: components["schemas"]["CharacteristicsAnswer"];
            readonly comparison: components["schemas"]["ComparisonAnswer"];
            readonly core_version: string;
            readonly id: string;
            readonly requirement_results?: readonly components["schemas"]["RequirementResult"][];
            readonly roads: number;
            readonly scenario: JsonObject;
            readonly strategies: {
                readonly [key: string]: components["schemas"]["CachedRoadsResult"] | components["schemas"]["CachedFailure"];
            };
        };
        readonly CreatedRun: {
            readonly cautions: readonly components["schemas"]["CautionAnswer"][];
            readonly characteristics: components["schemas"]["CharacteristicsAnswer"];
            readonly comparison: components["schemas"]["ComparisonAnswer"];
            readonly core_version: string;
            readonly id: string;
            readonly requirement_results?: readonly components["schemas"]["RequirementResult"][];
            readonly scenario: JsonObject;
            readonly strategies: {
                readonly [key: string]: components["schemas"]["CachedResult"] | components["schemas"]["CachedFailure"];
            };
        };
        readonly DataSheet: {
            readonly cg_height?: number;
            readonly front_axle_load: number;
            readonly front_axle_mass: number;
            readonly front_damping_ratio: number;
            readonly front_frequency: number;
            readonly front_tyre_stiffness: number;
            readonly pitch_inertia?: number | null;
            readonly rear_axle_load: number;
            readonly rear_axle_mass: number;
            readonly rear_damping_ratio: number;
            readonly rear_frequency: number;
            readonly rear_tyre_stiffness: number;
            readonly wheelbase: number;
        };
        readonly DescribedTable: {
            readonly curve: components["schemas"]["TableCurve"] | null;
            readonly table: components["schemas"]["backend__table_models__TableAnswer"];
        };
        readonly Deviation: {
            readonly baseline_rms: number | null;
            readonly correlation: number | null;
            readonly peak: number | null;
            readonly rms: number | null;
        };
        readonly Deviations: {
            readonly baseline: string;
            readonly strategies: {
                readonly [key: string]: {
                    readonly [key: string]: components["schemas"]["Deviation"];
                };
            };
            readonly units: {
                readonly [key: string]: string;
            };
        };
        readonly Distance: {
            readonly mean: number;
            readonly median: number;
            readonly values: number;
        };
        readonly Distances: {
            readonly interpretation: string;
            readonly simulated: components["schemas"]["Distance"] | null;
            readonly uncontrolled: components["schemas"]["Distance"] | null;
        };
        readonly EqualSpeed: {
            readonly against: string;
            readonly cells: readonly components["schemas"]["Change"][];
            readonly label: string;
            readonly strategy: string;
        };
        readonly Erratum: {
            readonly here: string;
            readonly place: string;
            readonly printed: string;
        };
        readonly Estimate: {
            readonly contradictory: number;
            readonly estimated_cost: number;
            readonly estimated_seconds: number | null;
            readonly points: number;
            readonly total: number;
        };
        readonly EstimateAnswer: {
            readonly high: number;
            readonly low: number;
            readonly value: number;
        };
        readonly FailingRun: {
            readonly at: {
                readonly [key: string]: number | string | boolean | readonly (number | readonly number[])[] | {
                    readonly [key: string]: string;
                } | null;
            };
            readonly run: number;
            readonly value: number;
        };
        readonly Figure8: {
            readonly change_vs_passive: number;
            readonly high: number;
            readonly low: number;
            readonly signal: string;
            readonly statistic: string;
            readonly value: number;
            readonly window: string;
        };
        readonly Figures: {
            readonly figures: {
                readonly [key: string]: JsonObject;
            };
        };
        readonly FigureSummary: {
            readonly above_zero: number;
            readonly highest: components["schemas"]["Place"] | null;
            readonly lowest: components["schemas"]["Place"] | null;
            readonly margin: components["schemas"]["MarginSummary"] | null;
            readonly mean: number | null;
            readonly n: number;
            readonly nominal: number | null;
            readonly quantiles: readonly number[] | null;
            readonly sensitivity: readonly components["schemas"]["Sensitivity"][];
        };
        readonly FmuRequest: {
            /** @enum {string} */
            readonly of?: "controller" | "vehicle";
            readonly platforms?: readonly ("linux64" | "win64" | "darwin64")[];
            readonly scenario?: JsonObject;
            readonly strategy?: string;
            /** @enum {string} */
            readonly version?: "2.0" | "3.0";
        };
        readonly FoundBumpAnswer: {
            readonly height: number;
            readonly start: number;
            readonly width: number;
        };
        readonly FrequencyAnswer: {
            readonly bands: readonly (readonly number[])[];
            readonly frequency: readonly number[];
            readonly modes: readonly components["schemas"]["Mode"][];
            readonly stage: string;
            readonly strategies: {
                readonly [key: string]: components["schemas"]["StrategyFrequency"];
            };
        };
        readonly FrequencyRequest: {
            readonly frequencies?: readonly number[] | null;
            readonly outputs?: readonly ("body_acceleration" | "pitch_acceleration" | "front_tyre_load" | "rear_tyre_load" | "front_deflection" | "rear_deflection")[] | null;
            readonly scenario?: JsonObject;
            /** @enum {string} */
            readonly stage?: "cruise" | "brake" | "bump";
            readonly strategies: readonly string[];
        };
        readonly FuzzyAnswer: {
            readonly distance: components["schemas"]["FuzzyVariable"];
            readonly rules: readonly components["schemas"]["FuzzyRule"][];
            readonly speed_error: components["schemas"]["FuzzyVariable"];
            readonly surface: components["schemas"]["Surface"];
            readonly torque: components["schemas"]["FuzzyVariable"];
        };
        readonly FuzzyRequest: {
            readonly scenario?: JsonObject;
        };
        readonly FuzzyRule: {
            readonly if: components["schemas"]["Condition"];
            readonly then: string;
        };
        readonly FuzzySet: {
            readonly corners: readonly number[];
            readonly function: string;
            readonly name: string;
        };
        readonly FuzzyVariable: {
            readonly memberships: readonly (readonly number[])[];
            readonly sets: readonly components["schemas"]["FuzzySet"][];
            readonly unit: string;
            readonly universe: readonly number[];
        };
        readonly Generation: {
            readonly best: readonly (number | null)[];
            readonly feasible: number;
            readonly generation: number;
            readonly hypervolume: number | null;
            readonly trials: number;
        };
        readonly HalfCarAnswer: {
            readonly cautions: readonly components["schemas"]["CautionAnswer"][];
            readonly characteristics: components["schemas"]["CharacteristicsAnswer"];
            readonly vehicle: JsonObject;
        };
        readonly InstantAnswer: {
            readonly cost: {
                readonly [key: string]: number;
            } | null;
            readonly estimated_state: readonly number[] | null;
            readonly forces: components["schemas"]["InstantForces"];
            readonly limits: readonly components["schemas"]["ControllerLimit"][];
            readonly measurement: readonly number[];
            readonly parts: {
                readonly [key: string]: readonly number[];
            } | null;
            readonly position: number;
            readonly predicted_forces: readonly (readonly number[])[] | null;
            readonly predicted_states: readonly (readonly number[])[] | null;
            readonly predicted_time: readonly number[] | null;
            readonly preview: components["schemas"]["RoadAhead"] | null;
            readonly speed: number;
            readonly stage: string;
            readonly state: readonly number[];
            readonly step: number;
            readonly strategy: string;
            readonly time: number;
            readonly why: string;
        };
        readonly InstantForces: {
            readonly acting: readonly number[];
            readonly asked: readonly number[] | null;
            readonly command: readonly number[];
            readonly previous: readonly number[];
        };
        readonly Interpretation: {
            readonly agreement: components["schemas"]["Agreement"];
            readonly changes: JsonObject;
            readonly choices: {
                readonly [key: string]: string;
            };
            readonly counts: components["schemas"]["Counts"];
            readonly description: string;
            readonly ecu: components["schemas"]["Part"];
            readonly id: string;
            readonly reached: number;
            readonly simulated: components["schemas"]["Part"];
            readonly title: string;
            readonly total: number;
        };
        readonly Interval: {
            readonly high: number;
            readonly low: number;
            readonly mean: number;
        };
        readonly InvalidPlace: {
            readonly message: string;
            readonly pointer: string;
        };
        readonly IriAnswer: {
            readonly mean: number;
            readonly tracks: readonly number[];
        };
        readonly JobProblem: {
            readonly detail: string;
            readonly errors: readonly components["schemas"]["InvalidPlace"][];
            readonly status: number;
            readonly title: string;
            readonly type: string;
        };
        readonly Judgement: {
            readonly certain: boolean | null;
            readonly ci: readonly number[] | null;
            readonly our_change: number | null;
            /** @enum {string} */
            readonly verdict: "reached" | "smaller" | "contradicts" | "unavailable" | "pending";
        };
        readonly LabelRequest: {
            readonly label: string | null;
        };
        readonly LatinHypercube: {
            readonly ranges: {
                readonly [key: string]: readonly number[];
            };
            readonly samples: number;
            readonly seed?: number;
        };
        readonly Limit: {
            readonly at_most: number;
            readonly figure: string;
        };
        readonly LimitAnswer: {
            readonly at_most: number;
            readonly figure: string;
            readonly label: string;
            readonly unit: string;
        };
        readonly Link: {
            readonly batch: components["schemas"]["Batch"] | null;
            readonly computed_at: string;
            readonly core_version: string;
            readonly created_at: string;
            readonly current_core_version: string;
            readonly damaged_at: string | null;
            /** @enum {string} */
            readonly kind: "run" | "batch";
            readonly requirements?: readonly components["schemas"]["Requirement"][];
            readonly run: components["schemas"]["Run"] | components["schemas"]["RoadsRun"] | null;
            readonly scenario: JsonObject;
            readonly schema_version: number;
            readonly series_pinned: boolean;
            readonly slug: string;
            readonly url: string;
            readonly view: components["schemas"]["LinkView"];
        };
        readonly LinkHead: {
            readonly batch_id: string | null;
            readonly created_at: string;
            /** @enum {string} */
            readonly kind: "run" | "batch";
            readonly revoked_at: string | null;
            readonly run_id: string | null;
            readonly slug: string;
            readonly url: string;
        };
        readonly LinkInstant: {
            readonly position: number;
            readonly strategy: string;
        };
        readonly LinkPage: {
            readonly links: readonly components["schemas"]["LinkHead"][];
            readonly next: string | null;
        };
        readonly LinkPin: {
            readonly name: string;
            readonly run: string;
        };
        readonly LinkRequest: {
            readonly batch_id?: string | null;
            readonly requirements?: readonly components["schemas"]["Requirement"][];
            readonly run_id?: string | null;
            readonly view?: components["schemas"]["LinkView"];
        };
        readonly LinkView: {
            readonly against?: string | null;
            readonly axis?: ("distance" | "time") | null;
            readonly baseline?: string | null;
            readonly cursor?: number | null;
            readonly differences?: boolean | null;
            readonly hidden?: readonly string[] | null;
            readonly instant?: components["schemas"]["LinkInstant"] | null;
            readonly pins?: readonly components["schemas"]["LinkPin"][] | null;
            readonly plot?: ("points" | "map" | "trade_off") | null;
            readonly reference?: string | null;
            readonly strategies?: readonly string[] | null;
            readonly strategy?: string | null;
            readonly threshold?: number | "none" | null;
            readonly versus?: string | null;
            readonly x?: string | null;
            readonly y?: string | null;
            readonly zoom?: readonly [
                number,
                number
            ] | null;
        };
        readonly LiveRequest: {
            readonly against?: string | null;
            readonly baseline?: string | null;
            /** @enum {string} */
            readonly encoding?: "base64" | "binary";
            readonly part?: "bump" | null;
            readonly points?: number;
            readonly requirements?: readonly components["schemas"]["Requirement"][];
            readonly scenario?: JsonObject;
            readonly signals?: readonly string[] | null;
            readonly strategies: readonly string[];
        };
        readonly LiveResult: {
            readonly arrival_speed_kmh: number | null;
            readonly cached: boolean;
            readonly comfort: {
                readonly [key: string]: number | null;
            };
            readonly compute_ms: number;
            readonly core_version?: string | null;
            readonly events: {
                readonly [key: string]: boolean | number | null;
            };
            readonly metrics: {
                readonly [key: string]: {
                    readonly [key: string]: components["schemas"]["Statistics"];
                };
            };
            readonly recording?: components["schemas"]["RecordingReport"] | null;
            readonly reference: {
                readonly [key: string]: number | null;
            };
            readonly series: {
                readonly [key: string]: components["schemas"]["TypedArray"];
            };
            readonly source: components["schemas"]["Source"] | null;
            readonly stages: readonly components["schemas"]["Stage"][];
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            readonly status: "ok";
            readonly travel_time: number | null;
        };
        readonly LiveRun: {
            readonly cautions: readonly components["schemas"]["CautionAnswer"][];
            readonly characteristics: components["schemas"]["CharacteristicsAnswer"];
            readonly comparison: components["schemas"]["ComparisonAnswer"];
            readonly core_version: string;
            readonly scenario: JsonObject;
            readonly strategies: {
                readonly [key: string]: components["schemas"]["LiveResult"] | components["schemas"]["CachedFailure"];
            };
        };
        readonly LoginRequest: {
            readonly token: string;
        };
        readonly LoginState: {
            readonly name: string | null;
            readonly required: boolean;
        };
        readonly LoopMargin: {
            readonly delay: number | null;
            readonly gain: number | null;
            readonly gain_reduction: number | null;
            readonly phase: number | null;
        };
        readonly Margins: {
            readonly disk: number;
            readonly disk_gain: number | null;
            readonly disk_phase: number;
            readonly front: components["schemas"]["LoopMargin"];
            readonly rear: components["schemas"]["LoopMargin"];
        };
        readonly MarginSummary: {
            readonly better: number | null;
            readonly highest: components["schemas"]["Place"] | null;
            readonly lowest: components["schemas"]["Place"] | null;
            readonly mean: number | null;
            readonly n: number;
            readonly nominal: number | null;
            readonly pairs: number;
            readonly quantiles: readonly number[] | null;
            readonly sensitivity: readonly components["schemas"]["Sensitivity"][];
            readonly worse: number | null;
        };
        readonly Misprint: {
            readonly follows: number;
            readonly printed: number;
        };
        readonly Mode: {
            readonly damping_ratio: number;
            readonly natural_frequency: number;
        };
        readonly ModesAnswer: {
            readonly front_body: number;
            readonly front_wheel: number;
            readonly rear_body: number;
            readonly rear_wheel: number;
        };
        readonly Objective: {
            readonly figure?: string | null;
            /** @enum {string} */
            readonly kind: "paper" | "peaks" | "figure";
            readonly q?: readonly [
                number,
                number,
                number
            ];
            readonly window?: string;
        };
        readonly ObjectiveAnswer: {
            readonly figure: string | null;
            /** @enum {string} */
            readonly kind: "paper" | "peaks" | "figure";
            readonly label: string;
            readonly q: readonly number[];
            readonly unit: string;
            readonly window: string | null;
        };
        readonly Operations: {
            readonly least: number;
            readonly most: number;
        };
        readonly OurAbsolute: {
            readonly factor: number;
            readonly spread: number;
            readonly value: number;
        };
        readonly PairedChanges: {
            readonly against: string | null;
            readonly baseline: string | null;
            readonly changes: {
                readonly [key: string]: components["schemas"]["StrategyChanges"];
            };
            readonly roads: number;
        };
        readonly PaperAnswer: {
            readonly absolutes: components["schemas"]["Absolutes"];
            readonly agreement: components["schemas"]["Agreement"];
            readonly cells: readonly components["schemas"]["Cell"][];
            readonly complete: boolean;
            readonly core_version: string;
            readonly counts: components["schemas"]["Counts"];
            readonly ecu: components["schemas"]["Part"];
            readonly errata: readonly components["schemas"]["Erratum"][];
            readonly first_seed: number;
            readonly interpretation: string | null;
            readonly interpretations: readonly components["schemas"]["Interpretation"][];
            readonly progress: components["schemas"]["Progress"];
            readonly reached: number;
            readonly readings: readonly components["schemas"]["ReadingAnswer"][];
            readonly rules: {
                readonly [key: string]: string;
            };
            readonly scenario: JsonObject;
            readonly seeds: number;
            readonly simulated: components["schemas"]["Part"];
            readonly tables: readonly components["schemas"]["backend__paper__models__TableAnswer"][];
            readonly total: number;
            readonly unavailable: components["schemas"]["Unavailable"] | null;
            readonly without_preview: components["schemas"]["WithoutPreview"];
        };
        readonly PaperFigure: {
            readonly caption: string;
            readonly figure: JsonObject;
            readonly number: number;
            readonly title: string;
        };
        readonly PaperFigures: {
            readonly figures: readonly components["schemas"]["PaperFigure"][];
        };
        readonly Part: {
            readonly reached: number;
            readonly total: number;
        };
        readonly Place: {
            readonly at: {
                readonly [key: string]: number | string | boolean | readonly (number | readonly number[])[] | {
                    readonly [key: string]: string;
                } | null;
            };
            readonly run: number;
            readonly value: number;
        };
        readonly PresetAnswer: {
            readonly description: string;
            readonly id: string;
            readonly label: string;
            readonly scenario: JsonObject;
        };
        readonly ProblemAnswer: {
            readonly meaning: string;
            readonly name: string;
            readonly remedy: string;
            readonly statuses: readonly number[];
            readonly title: string;
        };
        readonly Progress: {
            readonly done: number;
            readonly total: number;
        };
        readonly QuantityAnswer: {
            readonly description: string;
            readonly key: string;
            readonly label: string;
            readonly notable: number;
            readonly symbol: string;
            readonly unit: string;
        };
        readonly ReadingAnswer: {
            readonly choices: readonly components["schemas"]["ReadingChoice"][];
            readonly chosen: string;
            readonly description: string;
            readonly id: string;
            readonly title: string;
        };
        readonly ReadingChoice: {
            readonly default: boolean;
            readonly id: string;
            readonly label: string;
            readonly source: string;
        };
        readonly ReadingRow: {
            readonly changed: number;
            readonly choice: string;
            readonly counts: components["schemas"]["Counts"];
            readonly reached: number;
            readonly reading: string;
            readonly total: number;
        };
        readonly ReadingsAnswer: {
            readonly complete: boolean;
            readonly rows: readonly components["schemas"]["ReadingRow"][];
            readonly unavailable: components["schemas"]["Unavailable"] | null;
        };
        readonly RecordedColumn: {
            readonly name: string;
            readonly signal: string | null;
            readonly unit: string;
        };
        readonly RecordingAnswer: {
            readonly distance: number | null;
            readonly duration: number | null;
            readonly id: string;
            readonly samples: number;
            readonly signals: readonly string[];
            readonly strategy: string;
        };
        readonly RecordingPage: {
            readonly next: string | null;
            readonly recordings: readonly components["schemas"]["RecordingRow"][];
        };
        readonly RecordingReport: {
            readonly end: number;
            readonly likeness: number | null;
            readonly missing: readonly string[];
            readonly notes: readonly string[];
            readonly offset: number | null;
            readonly reference: string | null;
            readonly samples: number;
            readonly scale: number | null;
            readonly start: number;
        };
        readonly RecordingRow: {
            readonly created_at: string;
            readonly id: string;
            readonly samples: number;
            readonly signals: readonly string[];
            readonly strategy: string;
        };
        readonly Requirement: {
            readonly max?: number | null;
            readonly max_change?: number | null;
            readonly metric: string;
            readonly min?: number | null;
            readonly strategies?: readonly string[] | null;
        };
        readonly RequirementResult: {
            readonly baseline: string | null;
            readonly high: number | null;
            readonly low: number | null;
            readonly max: number | null;
            readonly max_change: number | null;
            readonly metric: string;
            readonly min: number | null;
            readonly reason: string | null;
            /** @enum {string} */
            readonly result: "pass" | "fail" | "uncertain";
            readonly strategy: string;
            readonly value: number | null;
        };
        readonly Response: {
            readonly magnitude: readonly number[];
            readonly phase: readonly number[];
        };
        readonly RoadAhead: {
            readonly mode: string;
            readonly position: readonly number[];
            readonly real: readonly (readonly number[])[];
            readonly seen: readonly (readonly number[])[];
            readonly time: readonly number[];
        };
        readonly RoadAnswer: {
            readonly bumps: readonly components["schemas"]["FoundBumpAnswer"][];
            readonly cautions: readonly components["schemas"]["CautionAnswer"][];
            readonly distance: readonly number[];
            readonly height: readonly number[];
            readonly id: string;
            readonly iri: components["schemas"]["IriAnswer"] | null;
            readonly iso_class: string | null;
            readonly length: number;
            readonly roughness: components["schemas"]["EstimateAnswer"] | null;
            readonly samples: number;
            readonly spectrum: components["schemas"]["SpectrumAnswer"] | null;
            readonly waviness: components["schemas"]["EstimateAnswer"] | null;
        };
        readonly RoadPage: {
            readonly next: string | null;
            readonly roads: readonly components["schemas"]["RoadRow"][];
        };
        readonly RoadRow: {
            readonly created_at: string;
            readonly id: string;
            readonly length: number;
            readonly samples: number;
        };
        readonly RoadsResult: {
            readonly arrival_speed_kmh: number | null;
            readonly comfort: {
                readonly [key: string]: components["schemas"]["Interval"];
            };
            readonly compute_ms: number;
            readonly core_version: string | null;
            readonly events: {
                readonly [key: string]: boolean | number | null;
            };
            readonly metrics: {
                readonly [key: string]: {
                    readonly [key: string]: components["schemas"]["RoadsStatistics"];
                };
            };
            readonly reference: {
                readonly [key: string]: number | null;
            };
            readonly source: components["schemas"]["Source"] | null;
            readonly stages: readonly components["schemas"]["Stage"][];
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            readonly status: "ok";
            readonly travel_time: number | null;
        };
        readonly RoadsRun: {
            readonly baseline: string;
            readonly cautions: readonly components["schemas"]["CautionAnswer"][];
            readonly changes: {
                readonly [key: string]: components["schemas"]["StrategyChanges"];
            };
            readonly characteristics: components["schemas"]["CharacteristicsAnswer"];
            readonly comparison: components["schemas"]["ComparisonAnswer"];
            readonly core_version: string;
            readonly id: string;
            readonly requirement_results?: readonly components["schemas"]["RequirementResult"][];
            readonly roads: number;
            readonly scenario: JsonObject;
            readonly strategies: {
                readonly [key: string]: components["schemas"]["RoadsResult"] | components["schemas"]["StrategyFailure"];
            };
        };
        readonly RoadsStatistics: {
            readonly peak: components["schemas"]["Interval"];
            readonly rms: components["schemas"]["Interval"];
        };
        readonly RobustnessDefaults: {
            readonly baseline: string;
            readonly figures: readonly string[];
            readonly ranges: readonly components["schemas"]["UncertainRange"][];
            readonly samples: number;
            readonly strategies: readonly string[];
        };
        readonly Run: {
            readonly cautions: readonly components["schemas"]["CautionAnswer"][];
            readonly characteristics: components["schemas"]["CharacteristicsAnswer"];
            readonly comparison: components["schemas"]["ComparisonAnswer"];
            readonly core_version: string;
            readonly id: string;
            readonly requirement_results?: readonly components["schemas"]["RequirementResult"][];
            readonly scenario: JsonObject;
            readonly strategies: {
                readonly [key: string]: components["schemas"]["StrategyResult"] | components["schemas"]["StrategyFailure"];
            };
        };
        readonly RunRequest: {
            readonly against?: string | null;
            readonly baseline?: string | null;
            readonly requirements?: readonly components["schemas"]["Requirement"][];
            readonly roads?: number;
            readonly scenario?: JsonObject;
            readonly strategies: readonly string[];
        };
        readonly Sensitivity: {
            readonly effect: number;
            readonly field: string;
            readonly p_value: number;
            readonly spearman: number;
        };
        readonly Series: {
            readonly core_version: string;
            readonly series: {
                readonly [key: string]: readonly (number | null)[] | components["schemas"]["TypedArray"];
            };
            readonly strategy: string;
            readonly units: {
                readonly [key: string]: string;
            };
        };
        readonly SeriesOfSeveral: {
            readonly core_version: string;
            readonly strategies: {
                readonly [key: string]: {
                    readonly [key: string]: readonly (number | null)[] | components["schemas"]["TypedArray"];
                };
            };
            readonly units: {
                readonly [key: string]: string;
            };
        };
        readonly Share: {
            readonly preview: number;
            readonly signal: string;
            readonly speed: number;
            readonly statistic: string;
            readonly switching: number;
            readonly total_change: number;
            readonly window: string;
        };
        readonly Solution: {
            readonly bracket: readonly [
                number,
                number
            ];
            readonly core_version: string;
            readonly interval: components["schemas"]["Interval"] | null;
            readonly metric_unit: string;
            readonly metric_value: number;
            readonly requirement_results: readonly components["schemas"]["RequirementResult"][];
            readonly resolution: number | null;
            readonly resolved_value: number;
            readonly run_id: string;
            readonly runs: number;
            readonly tried: readonly components["schemas"]["TriedValue"][];
            readonly unit: string;
            readonly value: number;
            readonly warnings: readonly string[];
        };
        readonly SolveRequest: {
            readonly baseline?: string | null;
            readonly field: string;
            readonly limit?: number | null;
            readonly metric?: string | null;
            readonly range: readonly [
                number,
                number
            ];
            readonly requirements?: readonly components["schemas"]["Requirement"][];
            readonly roads?: number;
            readonly scenario?: JsonObject;
            readonly strategy: string;
        };
        readonly Source: {
            readonly digest: string;
            readonly file: string;
        };
        readonly SpectrumAnswer: {
            readonly density: readonly number[];
            readonly frequency: readonly number[];
        };
        readonly StabilitySummary: {
            readonly highest: components["schemas"]["Place"] | null;
            readonly known: number;
            readonly lowest: components["schemas"]["Place"] | null;
            readonly mean: number | null;
            readonly n: number;
            readonly nominal: number | null;
            readonly quantiles: readonly number[] | null;
            readonly sensitivity: readonly components["schemas"]["Sensitivity"][];
            readonly unstable: number;
        };
        readonly Stage: {
            readonly end_position: number;
            readonly end_time: number;
            /** @enum {string} */
            readonly stage: "cruise" | "brake" | "bump";
            readonly start_position: number;
            readonly start_time: number;
        };
        readonly Statistics: {
            readonly peak: number | null;
            readonly rms: number | null;
        };
        readonly StepTime: {
            readonly least: number;
            readonly most: number;
        };
        readonly StrategyAnswer: {
            readonly colour: string;
            readonly dark_colour: string;
            readonly dash: string;
            readonly description: string;
            readonly fault: string | null;
            readonly id: string;
            readonly label: string;
            readonly one_road_resolution: {
                readonly [key: string]: number;
            };
            readonly options: JsonObject;
            readonly own: boolean;
            readonly reads: readonly string[];
            readonly reads_when: readonly components["schemas"]["ConditionalReadsAnswer"][];
            readonly source: components["schemas"]["Source"] | null;
        };
        readonly StrategyChanges: {
            readonly bump: {
                readonly [key: string]: components["schemas"]["Changes"];
            };
            readonly comfort: {
                readonly [key: string]: components["schemas"]["Interval"] | null;
            };
            readonly rough_road: {
                readonly [key: string]: components["schemas"]["Changes"];
            };
            readonly whole: {
                readonly [key: string]: components["schemas"]["Changes"];
            };
        };
        readonly StrategyFailure: {
            readonly compute_ms: number;
            readonly fields: readonly string[];
            /** @enum {string} */
            readonly kind: "refused" | "too-expensive" | "unavailable";
            readonly reason: string;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            readonly status: "failed";
        };
        readonly StrategyFrequency: {
            readonly bands: {
                readonly [key: string]: readonly number[];
            } | null;
            readonly margins: components["schemas"]["Margins"] | null;
            readonly modes: readonly components["schemas"]["Mode"][] | null;
            readonly psd: {
                readonly [key: string]: readonly number[];
            } | null;
            readonly reason: string | null;
            readonly responses: {
                readonly [key: string]: components["schemas"]["Response"];
            } | null;
            readonly speed: number;
        };
        readonly StrategyResult: {
            readonly arrival_speed_kmh: number | null;
            readonly comfort: {
                readonly [key: string]: number | null;
            };
            readonly compute_ms: number;
            readonly core_version?: string | null;
            readonly events: {
                readonly [key: string]: boolean | number | null;
            };
            readonly metrics: {
                readonly [key: string]: {
                    readonly [key: string]: components["schemas"]["Statistics"];
                };
            };
            readonly recording?: components["schemas"]["RecordingReport"] | null;
            readonly reference: {
                readonly [key: string]: number | null;
            };
            readonly source: components["schemas"]["Source"] | null;
            readonly stages: readonly components["schemas"]["Stage"][];
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            readonly status: "ok";
            readonly travel_time: number | null;
        };
        readonly StrategySummary: {
            readonly failed: number;
            readonly figures: {
                readonly [key: string]: components["schemas"]["FigureSummary"];
            };
            readonly ok: number;
            readonly reasons: {
                readonly [key: string]: number;
            };
            readonly stability: components["schemas"]["StabilitySummary"];
            readonly unfinished: number;
        };
        readonly Surface: {
            readonly distance: readonly number[];
            readonly speed_error: readonly number[];
            readonly torque: readonly (readonly number[])[];
        };
        readonly Sweep: {
            readonly grid?: {
                readonly [key: string]: readonly (number | string | boolean | null | readonly (number | readonly number[])[])[];
            } | null;
            readonly latin_hypercube?: components["schemas"]["LatinHypercube"] | null;
            readonly linked?: {
                readonly [key: string]: readonly string[];
            } | null;
            readonly list?: readonly {
                readonly [key: string]: number | string | boolean | null | readonly (number | readonly number[])[];
            }[] | null;
        };
        readonly TableClock: {
            readonly column: number | null;
            readonly rate: number | null;
            readonly spacing: number | null;
        };
        readonly TableColumn: {
            /** @enum {string} */
            readonly direction: "up" | "down";
            readonly index: number;
            readonly likely: string | null;
            readonly means: string | null;
            readonly sure: boolean;
            readonly title: string;
            readonly unit: string;
        };
        readonly TableCurve: {
            readonly along: string;
            readonly signals: readonly string[];
            readonly values: readonly (readonly (number | null)[])[];
            readonly x: readonly number[];
        };
        readonly TableQuestion: {
            readonly choices: readonly string[];
            readonly field: string;
            readonly guess: string | number | null;
            readonly text: string;
        };
        readonly Trial: {
            readonly feasible: boolean;
            readonly generation: number;
            readonly limits: readonly number[] | null;
            readonly number: number;
            readonly reason: string | null;
            /** @enum {string} */
            readonly status: "ok" | "failed";
            readonly values: readonly number[] | null;
            readonly weights: {
                readonly [key: string]: number | string | readonly number[];
            };
        };
        readonly TrialCounts: {
            readonly done: number;
            readonly failed: number;
            readonly feasible: number;
            readonly total: number;
        };
        readonly Trials: {
            readonly trials: readonly components["schemas"]["Trial"][];
            readonly tuning: string;
        };
        readonly TriedValue: {
            readonly metric_value: number | null;
            readonly reason: string | null;
            readonly run_id: string | null;
            readonly value: number;
        };
        readonly TunedChange: {
            readonly high: number | null;
            readonly low: number | null;
            readonly value: number;
        };
        readonly TunedFigures: {
            readonly change: components["schemas"]["TunedChange"] | null;
            readonly mean: number;
            readonly quantile: number | null;
            readonly worst: number;
        };
        readonly Tuning: {
            readonly batch: string | null;
            readonly best: readonly (components["schemas"]["Trial"] | null)[];
            readonly comparison: components["schemas"]["TuningComparison"] | null;
            readonly core_version: string;
            readonly created_at: string;
            readonly estimated_cost: number | null;
            readonly finished_at: string | null;
            readonly fresh_seeds: readonly number[];
            readonly front: readonly components["schemas"]["Trial"][];
            readonly generation: number;
            readonly history: readonly components["schemas"]["Generation"][];
            readonly id: string;
            readonly knee: components["schemas"]["Trial"] | null;
            readonly label: string | null;
            readonly limits: readonly components["schemas"]["LimitAnswer"][];
            readonly objectives: readonly components["schemas"]["ObjectiveAnswer"][];
            readonly own: components["schemas"]["Trial"] | null;
            readonly paper: components["schemas"]["Trial"] | null;
            readonly population: number;
            readonly position: number;
            readonly previews: readonly string[] | null;
            readonly problem: components["schemas"]["JobProblem"] | null;
            readonly quantile: number | null;
            readonly reason: string | null;
            readonly scenario: JsonObject;
            readonly search: {
                readonly [key: string]: readonly number[];
            };
            readonly seed: number;
            readonly seeds: readonly number[];
            readonly source: components["schemas"]["Source"] | null;
            readonly started_at: string | null;
            /** @enum {string} */
            readonly state: "planning" | "queued" | "running" | "done" | "cancelled" | "failed";
            /** @enum {string} */
            readonly step: "search" | "comparison";
            readonly strategy: string;
            readonly trials: components["schemas"]["TrialCounts"];
            readonly uncertain: boolean;
        };
        readonly TuningComparison: {
            readonly batch: string;
            readonly figures: readonly components["schemas"]["ComparedFigure"][];
            readonly points: readonly components["schemas"]["ComparedPoint"][];
        };
        readonly TuningEstimate: {
            readonly estimated_cost: number;
            readonly estimated_seconds: number | null;
            readonly generations: number;
            readonly runs: number;
        };
        readonly TuningItem: {
            readonly batch: string | null;
            readonly core_version: string;
            readonly created_at: string;
            readonly estimated_cost: number | null;
            readonly finished_at: string | null;
            readonly fresh_seeds: readonly number[];
            readonly generation: number;
            readonly id: string;
            readonly label: string | null;
            readonly limits: readonly components["schemas"]["LimitAnswer"][];
            readonly objectives: readonly components["schemas"]["ObjectiveAnswer"][];
            readonly population: number;
            readonly position: number;
            readonly previews: readonly string[] | null;
            readonly problem: components["schemas"]["JobProblem"] | null;
            readonly quantile: number | null;
            readonly reason: string | null;
            readonly search: {
                readonly [key: string]: readonly number[];
            };
            readonly seed: number;
            readonly seeds: readonly number[];
            readonly source: components["schemas"]["Source"] | null;
            readonly started_at: string | null;
            /** @enum {string} */
            readonly state: "planning" | "queued" | "running" | "done" | "cancelled" | "failed";
            /** @enum {string} */
            readonly step: "search" | "comparison";
            readonly strategy: string;
            readonly trials: components["schemas"]["TrialCounts"];
            readonly uncertain: boolean;
        };
        readonly TuningRequest: {
            readonly dry_run?: boolean;
            readonly fresh_seeds?: readonly number[];
            readonly label?: string | null;
            readonly limits?: readonly components["schemas"]["Limit"][];
            readonly objectives?: readonly components["schemas"]["Objective"][];
            readonly population?: number;
            readonly previews?: readonly string[] | null;
            readonly quantile?: number | null;
            readonly scenario?: JsonObject;
            readonly search?: {
                readonly [key: string]: readonly [
                    number,
                    number
                ];
            } | null;
            readonly seed?: number;
            readonly seeds?: readonly number[];
            readonly strategy?: string;
            readonly trials?: number;
            readonly uncertain?: boolean;
        };
        readonly Tunings: {
            readonly next: string | null;
            readonly tunings: readonly components["schemas"]["TuningItem"][];
        };
        readonly TypedArray: {
            readonly bdata: string;
            /** @constant */
            readonly dtype: "f4";
        };
        readonly Unavailable: {
            readonly cells: number;
            readonly reason: string;
        };
        readonly UncertainRange: {
            readonly field: string;
            readonly high: number;
            readonly low: number;
            readonly title: string;
            readonly unit: string;
            readonly why: string;
        };
        readonly VehicleAnswer: {
            readonly cautions: readonly components["schemas"]["CautionAnswer"][];
            readonly characteristics: components["schemas"]["CharacteristicsAnswer"];
            readonly derived: readonly string[];
            readonly description: string;
            readonly id: string;
            readonly label: string;
            readonly sources: readonly string[];
            readonly vehicle: JsonObject;
        };
        readonly VerdictAnswer: {
            readonly best: {
                readonly [key: string]: string | null;
            };
            readonly mixed: boolean;
            readonly text: string;
        };
        readonly WithoutPreview: {
            readonly counts: components["schemas"]["Counts"];
            readonly reached: number;
        };
    };
    responses: never;
    parameters: never;
    requestBodies: never;
    headers: never;
    pathItems: never;
}
export type AbsoluteRow = components['schemas']['AbsoluteRow'];
export type Absolutes = components['schemas']['Absolutes'];
export type Agreement = components['schemas']['Agreement'];
export type AttributionAnswer = components['schemas']['AttributionAnswer'];
export type AxlesAnswer = components['schemas']['AxlesAnswer'];
export type BackendPaperModelsTableAnswer = components['schemas']['backend__paper__models__TableAnswer'];
export type BackendTableModelsTableAnswer = components['schemas']['backend__table_models__TableAnswer'];
export type Band = components['schemas']['Band'];
export type Bands = components['schemas']['Bands'];
export type Batch = components['schemas']['Batch'];
export type Batches = components['schemas']['Batches'];
export type BatchField = components['schemas']['BatchField'];
export type BatchItem = components['schemas']['BatchItem'];
export type BatchRequest = components['schemas']['BatchRequest'];
export type BatchRequirementResult = components['schemas']['BatchRequirementResult'];
export type BatchRequirements = components['schemas']['BatchRequirements'];
export type BatchResults = components['schemas']['BatchResults'];
export type BatchRow = components['schemas']['BatchRow'];
export type BatchSummary = components['schemas']['BatchSummary'];
export type BatchTable = components['schemas']['BatchTable'];
export type CachedFailure = components['schemas']['CachedFailure'];
export type CachedResult = components['schemas']['CachedResult'];
export type CachedRoadsResult = components['schemas']['CachedRoadsResult'];
export type Catalogue = components['schemas']['Catalogue'];
export type CautionAnswer = components['schemas']['CautionAnswer'];
export type Cell = components['schemas']['Cell'];
export type Change = components['schemas']['Change'];
export type ChangeAnswer = components['schemas']['ChangeAnswer'];
export type Changes = components['schemas']['Changes'];
export type CharacteristicsAnswer = components['schemas']['CharacteristicsAnswer'];
export type Column = components['schemas']['Column'];
export type CombinationRow = components['schemas']['CombinationRow'];
export type Comfort = components['schemas']['Comfort'];
export type ComparedFigure = components['schemas']['ComparedFigure'];
export type ComparedPoint = components['schemas']['ComparedPoint'];
export type ComparisonAnswer = components['schemas']['ComparisonAnswer'];
export type Compilers = components['schemas']['Compilers'];
export type Condition = components['schemas']['Condition'];
export type ConditionalReadsAnswer = components['schemas']['ConditionalReadsAnswer'];
export type ConditionAnswer = components['schemas']['ConditionAnswer'];
export type ControllerLimit = components['schemas']['ControllerLimit'];
export type ControllerPart = components['schemas']['ControllerPart'];
export type ControllerReport = components['schemas']['ControllerReport'];
export type ControllerRequest = components['schemas']['ControllerRequest'];
export type ControllerRow = components['schemas']['ControllerRow'];
export type Counts = components['schemas']['Counts'];
export type CreatedLink = components['schemas']['CreatedLink'];
export type CreatedRecording = components['schemas']['CreatedRecording'];
export type CreatedRoad = components['schemas']['CreatedRoad'];
export type CreatedRoadsRun = components['schemas']['CreatedRoadsRun'];
export type CreatedRun = components['schemas']['CreatedRun'];
export type DataSheet = components['schemas']['DataSheet'];
export type DescribedTable = components['schemas']['DescribedTable'];
export type Deviation = components['schemas']['Deviation'];
export type Deviations = components['schemas']['Deviations'];
export type Distance = components['schemas']['Distance'];
export type Distances = components['schemas']['Distances'];
export type EqualSpeed = components['schemas']['EqualSpeed'];
export type Erratum = components['schemas']['Erratum'];
export type Estimate = components['schemas']['Estimate'];
export type EstimateAnswer = components['schemas']['EstimateAnswer'];
export type FailingRun = components['schemas']['FailingRun'];
export type Figure8 = components['schemas']['Figure8'];
export type Figures = components['schemas']['Figures'];
export type FigureSummary = components['schemas']['FigureSummary'];
export type FmuRequest = components['schemas']['FmuRequest'];
export type FoundBumpAnswer = components['schemas']['FoundBumpAnswer'];
export type FrequencyAnswer = components['schemas']['FrequencyAnswer'];
export type FrequencyRequest = components['schemas']['FrequencyRequest'];
export type FuzzyAnswer = components['schemas']['FuzzyAnswer'];
export type FuzzyRequest = components['schemas']['FuzzyRequest'];
export type FuzzyRule = components['schemas']['FuzzyRule'];
export type FuzzySet = components['schemas']['FuzzySet'];
export type FuzzyVariable = components['schemas']['FuzzyVariable'];
export type Generation = components['schemas']['Generation'];
export type HalfCarAnswer = components['schemas']['HalfCarAnswer'];
export type InstantAnswer = components['schemas']['InstantAnswer'];
export type InstantForces = components['schemas']['InstantForces'];
export type Interpretation = components['schemas']['Interpretation'];
export type Interval = components['schemas']['Interval'];
export type InvalidPlace = components['schemas']['InvalidPlace'];
export type IriAnswer = components['schemas']['IriAnswer'];
export type JobProblem = components['schemas']['JobProblem'];
export type Judgement = components['schemas']['Judgement'];
export type LabelRequest = components['schemas']['LabelRequest'];
export type LatinHypercube = components['schemas']['LatinHypercube'];
export type Limit = components['schemas']['Limit'];
export type LimitAnswer = components['schemas']['LimitAnswer'];
export type Link = components['schemas']['Link'];
export type LinkHead = components['schemas']['LinkHead'];
export type LinkInstant = components['schemas']['LinkInstant'];
export type LinkPage = components['schemas']['LinkPage'];
export type LinkPin = components['schemas']['LinkPin'];
export type LinkRequest = components['schemas']['LinkRequest'];
export type LinkView = components['schemas']['LinkView'];
export type LiveRequest = components['schemas']['LiveRequest'];
export type LiveResult = components['schemas']['LiveResult'];
export type LiveRun = components['schemas']['LiveRun'];
export type LoginRequest = components['schemas']['LoginRequest'];
export type LoginState = components['schemas']['LoginState'];
export type LoopMargin = components['schemas']['LoopMargin'];
export type Margins = components['schemas']['Margins'];
export type MarginSummary = components['schemas']['MarginSummary'];
export type Misprint = components['schemas']['Misprint'];
export type Mode = components['schemas']['Mode'];
export type ModesAnswer = components['schemas']['ModesAnswer'];
export type Objective = components['schemas']['Objective'];
export type ObjectiveAnswer = components['schemas']['ObjectiveAnswer'];
export type Operations = components['schemas']['Operations'];
export type OurAbsolute = components['schemas']['OurAbsolute'];
export type PairedChanges = components['schemas']['PairedChanges'];
export type PaperAnswer = components['schemas']['PaperAnswer'];
export type PaperFigure = components['schemas']['PaperFigure'];
export type PaperFigures = components['schemas']['PaperFigures'];
export type Part = components['schemas']['Part'];
export type Place = components['schemas']['Place'];
export type PresetAnswer = components['schemas']['PresetAnswer'];
export type ProblemAnswer = components['schemas']['ProblemAnswer'];
export type Progress = components['schemas']['Progress'];
export type QuantityAnswer = components['schemas']['QuantityAnswer'];
export type ReadingAnswer = components['schemas']['ReadingAnswer'];
export type ReadingChoice = components['schemas']['ReadingChoice'];
export type ReadingRow = components['schemas']['ReadingRow'];
export type ReadingsAnswer = components['schemas']['ReadingsAnswer'];
export type RecordedColumn = components['schemas']['RecordedColumn'];
export type RecordingAnswer = components['schemas']['RecordingAnswer'];
export type RecordingPage = components['schemas']['RecordingPage'];
export type RecordingReport = components['schemas']['RecordingReport'];
export type RecordingRow = components['schemas']['RecordingRow'];
export type Requirement = components['schemas']['Requirement'];
export type RequirementResult = components['schemas']['RequirementResult'];
export type Response = components['schemas']['Response'];
export type RoadAhead = components['schemas']['RoadAhead'];
export type RoadAnswer = components['schemas']['RoadAnswer'];
export type RoadPage = components['schemas']['RoadPage'];
export type RoadRow = components['schemas']['RoadRow'];
export type RoadsResult = components['schemas']['RoadsResult'];
export type RoadsRun = components['schemas']['RoadsRun'];
export type RoadsStatistics = components['schemas']['RoadsStatistics'];
export type RobustnessDefaults = components['schemas']['RobustnessDefaults'];
export type Run = components['schemas']['Run'];
export type RunRequest = components['schemas']['RunRequest'];
export type Sensitivity = components['schemas']['Sensitivity'];
export type Series = components['schemas']['Series'];
export type SeriesOfSeveral = components['schemas']['SeriesOfSeveral'];
export type Share = components['schemas']['Share'];
export type Solution = components['schemas']['Solution'];
export type SolveRequest = components['schemas']['SolveRequest'];
export type Source = components['schemas']['Source'];
export type SpectrumAnswer = components['schemas']['SpectrumAnswer'];
export type StabilitySummary = components['schemas']['StabilitySummary'];
export type Stage = components['schemas']['Stage'];
export type Statistics = components['schemas']['Statistics'];
export type StepTime = components['schemas']['StepTime'];
export type StrategyAnswer = components['schemas']['StrategyAnswer'];
export type StrategyChanges = components['schemas']['StrategyChanges'];
export type StrategyFailure = components['schemas']['StrategyFailure'];
export type StrategyFrequency = components['schemas']['StrategyFrequency'];
export type StrategyResult = components['schemas']['StrategyResult'];
export type StrategySummary = components['schemas']['StrategySummary'];
export type Surface = components['schemas']['Surface'];
export type Sweep = components['schemas']['Sweep'];
export type TableClock = components['schemas']['TableClock'];
export type TableColumn = components['schemas']['TableColumn'];
export type TableCurve = components['schemas']['TableCurve'];
export type TableQuestion = components['schemas']['TableQuestion'];
export type Trial = components['schemas']['Trial'];
export type TrialCounts = components['schemas']['TrialCounts'];
export type Trials = components['schemas']['Trials'];
export type TriedValue = components['schemas']['TriedValue'];
export type TunedChange = components['schemas']['TunedChange'];
export type TunedFigures = components['schemas']['TunedFigures'];
export type Tuning = components['schemas']['Tuning'];
export type TuningComparison = components['schemas']['TuningComparison'];
export type TuningEstimate = components['schemas']['TuningEstimate'];
export type TuningItem = components['schemas']['TuningItem'];
export type TuningRequest = components['schemas']['TuningRequest'];
export type Tunings = components['schemas']['Tunings'];
export type TypedArray = components['schemas']['TypedArray'];
export type Unavailable = components['schemas']['Unavailable'];
export type UncertainRange = components['schemas']['UncertainRange'];
export type VehicleAnswer = components['schemas']['VehicleAnswer'];
export type VerdictAnswer = components['schemas']['VerdictAnswer'];
export type WithoutPreview = components['schemas']['WithoutPreview'];
export interface operations {
    readonly listBatches: {
        readonly parameters: {
            readonly query?: {
                readonly cursor?: string | null;
                readonly label?: string | null;
                readonly limit?: number;
                readonly state?: ("planning" | "queued" | "running" | "done" | "cancelled" | "failed") | null;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Batches"];
                };
            };
        };
    };
    readonly createBatch: {
        readonly parameters: {
            readonly header?: {
                readonly "idempotency-key"?: string | null;
            };
        };
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["BatchRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Estimate"];
                };
            };
            readonly 202: {
                content: {
                    readonly "application/json": components["schemas"]["Batch"];
                };
            };
        };
    };
    readonly getBatch: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Batch"];
                };
            };
        };
    };
    readonly deleteBatch: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 204: {
                content?: never;
            };
        };
    };
    readonly labelBatch: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["LabelRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Batch"];
                };
            };
        };
    };
    readonly cancelBatch: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Batch"];
                };
            };
        };
    };
    readonly getBatchEvents: {
        readonly parameters: {
            readonly query?: {
                readonly after?: number;
            };
            readonly header?: {
                readonly "last-event-id"?: string | null;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "text/event-stream": {
                        readonly data: string;
                        /** @enum {unknown} */
                        readonly event: "state" | "progress";
                        readonly id: string;
                    };
                };
            };
        };
    };
    readonly getBatchRequirements: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["BatchRequirements"];
                };
            };
        };
    };
    readonly getBatchResults: {
        readonly parameters: {
            readonly query?: {
                readonly cursor?: number;
                readonly format?: ("json" | "csv") | null;
                readonly limit?: number | null;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["BatchResults"];
                    readonly "text/csv": string;
                };
            };
        };
    };
    readonly resumeBatch: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Batch"];
                };
            };
        };
    };
    readonly getBatchSummary: {
        readonly parameters: {
            readonly query?: {
                readonly baseline?: string | null;
                readonly figures?: string;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["BatchSummary"];
                };
            };
        };
    };
    readonly getBatchSweep: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Sweep"];
                };
            };
        };
    };
    readonly getBatchTable: {
        readonly parameters: {
            readonly query?: {
                readonly figures?: string;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["BatchTable"];
                };
            };
        };
    };
    readonly getCatalogue: {
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Catalogue"];
                };
            };
        };
    };
    readonly exportController: {
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["ControllerRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/zip": string;
                };
            };
        };
    };
    readonly getCompilers: {
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Compilers"];
                };
            };
        };
    };
    readonly driveByClock: {
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": unknown;
                };
            };
        };
    };
    readonly reportController: {
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["ControllerRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["ControllerReport"];
                };
            };
        };
    };
    readonly getFigures: {
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Figures"];
                };
            };
        };
    };
    readonly exportFmu: {
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["FmuRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/zip": string;
                };
            };
        };
    };
    readonly frequency: {
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["FrequencyRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["FrequencyAnswer"];
                };
            };
        };
    };
    readonly fuzzy: {
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["FuzzyRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["FuzzyAnswer"];
                };
            };
        };
    };
    readonly listLinks: {
        readonly parameters: {
            readonly query?: {
                readonly cursor?: string | null;
                readonly limit?: number;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["LinkPage"];
                };
            };
        };
    };
    readonly createLink: {
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["LinkRequest"];
            };
        };
        readonly responses: {
            readonly 201: {
                content: {
                    readonly "application/json": components["schemas"]["CreatedLink"];
                };
            };
        };
    };
    readonly getLink: {
        readonly parameters: {
            readonly path: {
                readonly slug: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Link"];
                };
            };
        };
    };
    readonly revokeLink: {
        readonly parameters: {
            readonly path: {
                readonly slug: string;
            };
        };
        readonly responses: {
            readonly 204: {
                content?: never;
            };
        };
    };
    readonly live: {
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["LiveRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["LiveRun"];
                    readonly "application/octet-stream": string;
                };
            };
        };
    };
    readonly getLogin: {
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["LoginState"];
                };
            };
        };
    };
    readonly logIn: {
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["LoginRequest"];
            };
        };
        readonly responses: {
            readonly 204: {
                content?: never;
            };
        };
    };
    readonly logOut: {
        readonly responses: {
            readonly 204: {
                content?: never;
            };
        };
    };
    readonly getPaper: {
        readonly parameters: {
            readonly query?: {
                readonly braking_moment?: ("on" | "off") | null;
                readonly bump_speed?: ("22.5" | "20" | "25") | null;
                readonly first_seed?: number;
                readonly force_limit?: ("5" | "2.5" | "10" | "20" | "none") | null;
                readonly interpretation?: "default" | "favourable" | "nearest";
                readonly lqr_preview?: ("lookahead" | "obstacle" | "wheelbase" | "none") | null;
                readonly partial?: boolean;
                readonly preview?: ("lookahead" | "obstacle" | "wheelbase" | "none") | null;
                readonly rear_axle?: ("in_turn" | "together") | null;
                readonly road_end?: ("150" | "110") | null;
                readonly roughness?: ("B" | "C") | null;
                readonly sample_time?: ("10" | "5" | "20") | null;
                readonly seeds?: number;
                readonly travel_limit?: ("80" | "100" | "none") | null;
                readonly travel_weight?: ("3" | "0") | null;
                readonly tyre_loads?: ("computed" | "doubled") | null;
                readonly vehicle?: ("printed" | "half") | null;
                readonly window?: ("to_bump" | "class_b" | "full_course") | null;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["PaperAnswer"];
                };
            };
        };
    };
    readonly getPaperAttribution: {
        readonly parameters: {
            readonly query?: {
                readonly first_seed?: number;
                readonly seeds?: number;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["AttributionAnswer"];
                };
            };
        };
    };
    readonly getPaperFigures: {
        readonly parameters: {
            readonly query?: {
                readonly first_seed?: number;
                readonly seeds?: number;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["PaperFigures"];
                };
            };
        };
    };
    readonly getPaperReadings: {
        readonly parameters: {
            readonly query?: {
                readonly first_seed?: number;
                readonly seeds?: number;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["ReadingsAnswer"];
                };
            };
        };
    };
    readonly getPaperReport: {
        readonly parameters: {
            readonly query?: {
                readonly braking_moment?: ("on" | "off") | null;
                readonly bump_speed?: ("22.5" | "20" | "25") | null;
                readonly first_seed?: number;
                readonly force_limit?: ("5" | "2.5" | "10" | "20" | "none") | null;
                readonly interpretation?: "default" | "favourable" | "nearest";
                readonly lqr_preview?: ("lookahead" | "obstacle" | "wheelbase" | "none") | null;
                readonly preview?: ("lookahead" | "obstacle" | "wheelbase" | "none") | null;
                readonly rear_axle?: ("in_turn" | "together") | null;
                readonly road_end?: ("150" | "110") | null;
                readonly roughness?: ("B" | "C") | null;
                readonly sample_time?: ("10" | "5" | "20") | null;
                readonly seeds?: number;
                readonly travel_limit?: ("80" | "100" | "none") | null;
                readonly travel_weight?: ("3" | "0") | null;
                readonly tyre_loads?: ("computed" | "doubled") | null;
                readonly vehicle?: ("printed" | "half") | null;
                readonly window?: ("to_bump" | "class_b" | "full_course") | null;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "text/html": string;
                };
            };
        };
    };
    readonly getPresets: {
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": readonly components["schemas"]["PresetAnswer"][];
                };
            };
        };
    };
    readonly getProblems: {
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": readonly components["schemas"]["ProblemAnswer"][];
                };
            };
        };
    };
    readonly listRecordings: {
        readonly parameters: {
            readonly query?: {
                readonly cursor?: string | null;
                readonly limit?: number;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["RecordingPage"];
                };
            };
        };
    };
    readonly createRecording: {
        readonly parameters: {
            readonly query?: {
                readonly columns?: string | null;
                readonly dry_run?: boolean;
                readonly table?: string | null;
            };
        };
        readonly requestBody: {
            readonly content: {
                readonly "text/csv": string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["DescribedTable"];
                };
            };
            readonly 201: {
                content: {
                    readonly "application/json": components["schemas"]["CreatedRecording"];
                };
            };
        };
    };
    readonly getRecording: {
        readonly parameters: {
            readonly query?: {
                readonly format?: "json" | "csv";
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["RecordingAnswer"];
                    readonly "text/csv": string;
                };
            };
        };
    };
    readonly deleteRecording: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 204: {
                content?: never;
            };
        };
    };
    readonly listRoads: {
        readonly parameters: {
            readonly query?: {
                readonly cursor?: string | null;
                readonly limit?: number;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["RoadPage"];
                };
            };
        };
    };
    readonly createRoad: {
        readonly parameters: {
            readonly query?: {
                readonly dry_run?: boolean;
                readonly left?: number | null;
                readonly right?: number | null;
                readonly table?: string | null;
            };
        };
        readonly requestBody: {
            readonly content: {
                readonly "application/x-opencrg": string;
                readonly "text/csv": string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["DescribedTable"];
                };
            };
            readonly 201: {
                content: {
                    readonly "application/json": components["schemas"]["CreatedRoad"];
                };
            };
        };
    };
    readonly getRoad: {
        readonly parameters: {
            readonly query?: {
                readonly encoding?: "binary" | "text";
                readonly format?: "json" | "csv" | "crg";
                readonly points?: number;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["RoadAnswer"];
                    readonly "application/x-opencrg": string;
                    readonly "text/csv": string;
                };
            };
        };
    };
    readonly deleteRoad: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 204: {
                content?: never;
            };
        };
    };
    readonly getRobustnessDefaults: {
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["RobustnessDefaults"];
                };
            };
        };
    };
    readonly createRun: {
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["RunRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["CreatedRun"] | components["schemas"]["CreatedRoadsRun"];
                };
            };
        };
    };
    readonly getRun: {
        readonly parameters: {
            readonly query?: {
                readonly against?: string | null;
                readonly baseline?: string | null;
                readonly compare?: string | null;
                readonly requirements?: string | null;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Run"] | components["schemas"]["RoadsRun"];
                };
            };
        };
    };
    readonly getBands: {
        readonly parameters: {
            readonly query?: {
                readonly encoding?: "list" | "base64";
                readonly points?: number | null;
                readonly signals?: string | null;
                readonly strategy?: string | null;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Bands"];
                };
            };
        };
    };
    readonly getChanges: {
        readonly parameters: {
            readonly query?: {
                readonly against?: string | null;
                readonly baseline?: string | null;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["PairedChanges"];
                };
            };
        };
    };
    readonly getDifferences: {
        readonly parameters: {
            readonly query?: {
                readonly baseline?: string | null;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Deviations"];
                };
            };
        };
    };
    readonly getRunFigures: {
        readonly parameters: {
            readonly query?: {
                readonly x?: "position" | "time";
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Figures"];
                };
            };
        };
    };
    readonly getRunFigure: {
        readonly parameters: {
            readonly query?: {
                readonly x?: "position" | "time";
            };
            readonly path: {
                readonly id: string;
                readonly name: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": JsonObject;
                };
            };
        };
    };
    readonly getInstant: {
        readonly parameters: {
            readonly query?: {
                readonly position?: number | null;
                readonly strategy?: string | null;
                readonly time?: number | null;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["InstantAnswer"];
                };
            };
        };
    };
    readonly getRunReport: {
        readonly parameters: {
            readonly query?: {
                readonly against?: string | null;
                readonly baseline?: string | null;
                readonly requirements?: string | null;
                readonly x?: "position" | "time";
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "text/html": string;
                };
            };
        };
    };
    readonly getSeries: {
        readonly parameters: {
            readonly query?: {
                readonly encoding?: "list" | "base64";
                readonly format?: "json" | "csv";
                readonly points?: number | null;
                readonly signals?: string | null;
                readonly strategy?: string | null;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Series"] | components["schemas"]["SeriesOfSeveral"];
                    readonly "text/csv": string;
                };
            };
        };
    };
    readonly getSchema: {
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": JsonObject;
                };
            };
        };
    };
    readonly solve: {
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["SolveRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Solution"];
                };
            };
        };
    };
    readonly getStrategies: {
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": readonly components["schemas"]["StrategyAnswer"][];
                };
            };
        };
    };
    readonly listTunings: {
        readonly parameters: {
            readonly query?: {
                readonly cursor?: string | null;
                readonly label?: string | null;
                readonly limit?: number;
                readonly state?: ("planning" | "queued" | "running" | "done" | "cancelled" | "failed") | null;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Tunings"];
                };
            };
        };
    };
    readonly createTuning: {
        readonly parameters: {
            readonly header?: {
                readonly "idempotency-key"?: string | null;
            };
        };
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["TuningRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["TuningEstimate"];
                };
            };
            readonly 202: {
                content: {
                    readonly "application/json": components["schemas"]["Tuning"];
                };
            };
        };
    };
    readonly getTuning: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Tuning"];
                };
            };
        };
    };
    readonly deleteTuning: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 204: {
                content?: never;
            };
        };
    };
    readonly labelTuning: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["LabelRequest"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Tuning"];
                };
            };
        };
    };
    readonly cancelTuning: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Tuning"];
                };
            };
        };
    };
    readonly getTuningEvents: {
        readonly parameters: {
            readonly query?: {
                readonly after?: number;
            };
            readonly header?: {
                readonly "last-event-id"?: string | null;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "text/event-stream": {
                        readonly data: string;
                        /** @enum {unknown} */
                        readonly event: "state" | "progress" | "restart";
                        readonly id: string;
                    };
                };
            };
        };
    };
    readonly resumeTuning: {
        readonly parameters: {
            readonly query?: {
                readonly trials?: number | null;
            };
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Tuning"];
                };
            };
        };
    };
    readonly getTuningTrials: {
        readonly parameters: {
            readonly path: {
                readonly id: string;
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["Trials"];
                };
            };
        };
    };
    readonly getVehicles: {
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": readonly components["schemas"]["VehicleAnswer"][];
                };
            };
        };
    };
    readonly makeHalfCar: {
        readonly requestBody: {
            readonly content: {
                readonly "application/json": components["schemas"]["DataSheet"];
            };
        };
        readonly responses: {
            readonly 200: {
                content: {
                    readonly "application/json": components["schemas"]["HalfCarAnswer"];
                };
            };
        };
    };
}
