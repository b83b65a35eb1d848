// Generated from the backend's OpenAPI by `npm run api`; do not edit.

export interface paths {
    "/api/v1/batches": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Page
         * @description The newest first, page by page.
         */
        get: operations["listBatches"];
        put?: never;
        /**
         * Create Batch
         * @description Submit a sweep; 202 comes after the commit: what was accepted completes, whatever crashes.
         */
        post: operations["createBatch"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/batches/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get
         * @description The job's present state; its events report changes.
         */
        get: operations["getBatch"];
        put?: never;
        post?: never;
        /**
         * Delete
         * @description Remove one that has ended and that no link shows; with tokens only its owner may.
         */
        delete: operations["deleteBatch"];
        options?: never;
        head?: never;
        /**
         * Set Label
         * @description Name it, or take its name away.
         */
        patch: operations["labelBatch"];
        trace?: never;
    };
    "/api/v1/batches/{id}/cancel": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Cancel
         * @description Cancel it; finished runs stay. One that has ended is answered unchanged.
         */
        post: operations["cancelBatch"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/batches/{id}/events": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Events
         * @description Server-sent events; the last one is the final state.
         */
        get: operations["getBatchEvents"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/batches/{id}/results": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Batch Results
         * @description One row a run, in order, streamed; a batch that still runs has rows that wait.
         */
        get: operations["getBatchResults"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/batches/{id}/resume": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Resume Batch
         * @description A cancelled one goes on where it stopped; one under way is answered as it is.
         */
        post: operations["resumeBatch"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/batches/{id}/summary": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Batch Summary
         * @description Each figure's quantiles and extremes under each strategy, paired margins, what they follow, and stability.
         *
         *     Over the runs that have finished. The worst place of a figure is its `highest`.
         */
        get: operations["getBatchSummary"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/batches/{id}/table": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Batch Table
         * @description Rows column by column: run, strategy, status, reason, the swept fields and the figures asked for.
         */
        get: operations["getBatchTable"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/catalogue": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Catalogue
         * @description Signals, windows, statistics, stages, comfort, events, references: keys, labels and units.
         */
        get: operations["getCatalogue"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/controller": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Export Controller
         * @description The scenario's `lv_hil` controller as C sources; the same scenario gives the same bytes.
         */
        post: operations["exportController"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/controller/realtime": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Drive By Clock
         * @description Drive it once by the clock: latency, jitter, missed deadlines; takes as long as the drive, one at a time.
         */
        post: operations["driveByClock"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/controller/report": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Report Controller
         * @description Whether it fits an STM32F103, and which smaller controllers do; takes about ten seconds, one at a time.
         */
        post: operations["reportController"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/figures": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Figures
         * @description Figure templates in the order of display: layout, and a trace without data for each strategy.
         */
        get: operations["getFigures"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/links": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Create Link
         * @description Share a stored run or a batch; the answer comes after the commit.
         */
        post: operations["createLink"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/links/{slug}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Link
         * @description What a link opens: results as they were computed, the scenario as today's schema has it, the view.
         */
        get: operations["getLink"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/live": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Live
         * @description Figures and decimated time histories while somebody drags; nothing is stored.
         */
        post: operations["live"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/login": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Login
         * @description Whether the service wants a token.
         */
        get: operations["getLogin"];
        put?: never;
        /**
         * Log In
         * @description Keep the token in a cookie that no script can read; 401 where it is none of the service's.
         */
        post: operations["logIn"];
        /**
         * Log Out
         * @description Forget the cookie.
         */
        delete: operations["logOut"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/paper": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Paper
         * @description Every printed change of Tables 4-5 and 7-10 with ours and a verdict; readings by name of a set or singly.
         */
        get: operations["getPaper"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/paper/attribution": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Attribution
         * @description Preview, weights and speed varied one at a time, and how much of LV's gain each is.
         */
        get: operations["getPaperAttribution"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/paper/figures": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Figures
         * @description Figures 3-6, 8, 10-17 and 19-22 from our own runs.
         */
        get: operations["getPaperFigures"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/paper/readings": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Readings
         * @description What each reading does to the verdicts by itself; ask again while it is not complete.
         */
        get: operations["getPaperReadings"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/paper/report.html": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Report
         * @description All of this as one HTML file that needs nothing else; each reading may be chosen for its tables.
         */
        get: operations["getPaperReport"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/presets": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Presets
         * @description Named scenarios; the paper's first.
         */
        get: operations["getPresets"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/roads": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Create Road
         * @description Store a measured profile: distance and height, or left and right height, each column's unit in the header.
         */
        post: operations["createRoad"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/roads/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Road
         * @description A measured road; it never changes.
         */
        get: operations["getRoad"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/robustness": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Robustness Defaults
         * @description The uncertain fields of a robustness study by default: a batch over these ranges, read by its summary.
         */
        get: operations["getRobustnessDefaults"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Create Run
         * @description Run what is not stored yet, on one road or several; the answer comes after the commit.
         */
        post: operations["createRun"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Run
         * @description A stored run; it changes only where its results were removed and another core version computes them again.
         */
        get: operations["getRun"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/bands": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Bands
         * @description Of a run over several roads: mean, smallest and largest value over all roads at each sample, in SI units.
         */
        get: operations["getBands"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/changes": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Changes
         * @description What a run over several roads changes against another run: paired by road, strategy by strategy.
         */
        get: operations["getChanges"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/figures": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Run Figures
         * @description Every figure with this run's data.
         */
        get: operations["getRunFigures"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/figures/{name}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Run Figure
         * @description One figure with this run's data.
         */
        get: operations["getRunFigure"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/report.html": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Run Report
         * @description The run as one HTML file that needs nothing else; its figures are inside, or it says why there are none.
         */
        get: operations["getRunReport"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/series": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Series
         * @description Time histories in SI units; time and position always come along.
         */
        get: operations["getSeries"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/schema": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Schema
         * @description JSON Schema of the scenario: title, description, unit, default, hard limits and soft_range of each field.
         */
        get: operations["getSchema"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/solve": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Solve
         * @description The largest value of one field that keeps one metric at or below a limit, and the run at that value.
         */
        post: operations["solve"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/strategies": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Strategies
         * @description Every strategy: what it does, what it reads, how it is drawn.
         */
        get: operations["getStrategies"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tunings": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Page
         * @description The newest first, page by page.
         */
        get: operations["listTunings"];
        put?: never;
        /**
         * Create Tuning
         * @description Begin to look for better weights; 202 comes after the commit: what was accepted completes, whatever crashes.
         */
        post: operations["createTuning"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tunings/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get
         * @description The job's present state; its events report changes.
         */
        get: operations["getTuning"];
        put?: never;
        post?: never;
        /**
         * Delete
         * @description Remove one that has ended and that no link shows; with tokens only its owner may.
         */
        delete: operations["deleteTuning"];
        options?: never;
        head?: never;
        /**
         * Set Label
         * @description Name it, or take its name away.
         */
        patch: operations["labelTuning"];
        trace?: never;
    };
    "/api/v1/tunings/{id}/cancel": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Cancel
         * @description Cancel it; finished runs stay. One that has ended is answered unchanged.
         */
        post: operations["cancelTuning"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tunings/{id}/events": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Events
         * @description Server-sent events; the last one is the final state.
         */
        get: operations["getTuningEvents"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tunings/{id}/resume": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Resume Tuning
         * @description One that has ended goes on where it stopped, perhaps with more trials; one under way is answered as it is.
         */
        post: operations["resumeTuning"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tunings/{id}/trials": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Tuning Trials
         * @description Every trial of the complete generations, in order.
         */
        get: operations["getTuningTrials"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/vehicles": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Vehicles
         * @description Vehicles with their sources, as a scenario's `vehicle`.
         */
        get: operations["getVehicles"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/vehicles/from-data-sheet": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Make Half Car
         * @description The half-car of a whole car's data sheet: masses, axle loads, natural frequencies, damping ratios.
         */
        post: operations["makeHalfCar"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/healthz": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Healthz
         * @description The process answers.
         */
        get: operations["getHealth"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/metrics": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Metrics
         * @description Figures for Prometheus: counts, gauges and latencies, nothing of anybody's scenario.
         */
        get: operations["getMetrics"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/readyz": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Readyz
         * @description The store answers and a warm worker is there.
         */
        get: operations["getReadiness"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
}
export type webhooks = Record<string, never>;
export interface components {
    schemas: {
        /**
         * Actuator
         * @description Suspension actuators; ideal by default, as in the paper.
         */
        Actuator: {
            /**
             * Bandwidth
             * @description First-order lag between command and force, typically 10 Hz; none is ideal.
             */
            bandwidth?: number | null;
            /**
             * Force rate limit
             * @description Greatest change of the commanded force; none is unlimited.
             */
            rate_limit?: number | null;
            /**
             * Saturation
             * @description Greatest force the actuator gives, unknown to every controller; none: the force limit.
             */
            saturation?: number | null;
        };
        /**
         * Agreement
         * @description How close the simulated changes are to the paper's; for a misprint, to what follows from its absolutes.
         */
        Agreement: {
            /** Cells */
            cells: number;
            /**
             * In Interval
             * @description The paper's change lies in our 95 % interval
             */
            in_interval: number;
            /**
             * Within
             * @description Within ±10 percentage points of the paper's change
             */
            within: number;
        };
        /**
         * AttributionAnswer
         * @description What each part contributes.
         */
        AttributionAnswer: {
            /** Core Version */
            core_version: string;
            /** Equal Speed */
            equal_speed: components["schemas"]["EqualSpeed"][];
            /** First Seed */
            first_seed: number;
            /** Rows */
            rows: components["schemas"]["CombinationRow"][];
            /** Seeds */
            seeds: number;
            /** Sentences */
            sentences: string[];
            /** Shares */
            shares: components["schemas"]["Share"][];
        };
        /**
         * Band
         * @description One strategy's time histories over the roads: at each sample the mean, the smallest and the largest value.
         */
        Band: {
            /**
             * Maximum
             * @description Of the same signals as `minimum`
             */
            maximum: {
                [key: string]: (number | null)[] | components["schemas"]["TypedArray"];
            };
            /**
             * Mean
             * @description Lists, or typed arrays with encoding=base64
             */
            mean: {
                [key: string]: (number | null)[] | components["schemas"]["TypedArray"];
            };
            /**
             * Minimum
             * @description Without what is the same on every road, such as time, position and speed
             */
            minimum: {
                [key: string]: (number | null)[] | components["schemas"]["TypedArray"];
            };
        };
        /**
         * Bands
         * @description Time histories over several roads: samples lie at the same times and positions on each.
         */
        Bands: {
            /** Core Version */
            core_version: string;
            /** Roads */
            roads: number;
            /** Strategies */
            strategies: {
                [key: string]: components["schemas"]["Band"];
            };
            /** Units */
            units: {
                [key: string]: string;
            };
        };
        /**
         * Batch
         * @description A batch in its present state.
         */
        Batch: {
            /**
             * Core Version
             * @description That accepted it; each row names the one that computed it
             */
            core_version: string;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /** Done */
            done: number;
            /**
             * Estimated Cost
             * @description Estimate [s of one core]
             */
            estimated_cost: number;
            /** Failed */
            failed: number;
            /** Fields */
            fields: components["schemas"]["BatchField"][];
            /** Finished At */
            finished_at: string | null;
            /** Id */
            id: string;
            /** Label */
            label: string | null;
            /**
             * Notes
             * @description What its runs do not depend on; empty of old batches
             * @default []
             */
            notes: string[];
            /**
             * Position
             * @description Runs of batches accepted earlier that wait, until it runs: then they take turns
             */
            position: number;
            /**
             * Reason
             * @description Why the batch as a whole failed
             */
            reason: string | null;
            /** Scenario */
            scenario: {
                [key: string]: unknown;
            };
            /** Started At */
            started_at: string | null;
            /**
             * State
             * @enum {string}
             */
            state: "queued" | "running" | "done" | "cancelled" | "failed";
            /** Strategies */
            strategies: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive")[];
            /** Sweep */
            sweep: {
                [key: string]: unknown;
            };
            /** Total */
            total: number;
        };
        /**
         * Batches
         * @description A page of batches, the newest first.
         */
        Batches: {
            /** Batches */
            batches: components["schemas"]["BatchItem"][];
            /**
             * Next
             * @description Cursor of the next page; null on the last one
             */
            next: string | null;
        };
        /**
         * BatchField
         * @description A field the sweep changes.
         */
        BatchField: {
            /**
             * Linked To
             * @description The swept field whose value it takes
             */
            linked_to: string | null;
            /** Name */
            name: string;
            /** Title */
            title: string;
            /** Unit */
            unit: string;
        };
        /**
         * BatchItem
         * @description A batch in a list; `done` runs succeeded, `failed` runs did not and say why in their rows.
         */
        BatchItem: {
            /**
             * Core Version
             * @description That accepted it; each row names the one that computed it
             */
            core_version: string;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /** Done */
            done: number;
            /**
             * Estimated Cost
             * @description Estimate [s of one core]
             */
            estimated_cost: number;
            /** Failed */
            failed: number;
            /** Fields */
            fields: components["schemas"]["BatchField"][];
            /** Finished At */
            finished_at: string | null;
            /** Id */
            id: string;
            /** Label */
            label: string | null;
            /**
             * Notes
             * @description What its runs do not depend on; empty of old batches
             * @default []
             */
            notes: string[];
            /**
             * Position
             * @description Runs of batches accepted earlier that wait, until it runs: then they take turns
             */
            position: number;
            /**
             * Reason
             * @description Why the batch as a whole failed
             */
            reason: string | null;
            /** Scenario */
            scenario: {
                [key: string]: unknown;
            };
            /** Started At */
            started_at: string | null;
            /**
             * State
             * @enum {string}
             */
            state: "queued" | "running" | "done" | "cancelled" | "failed";
            /** Strategies */
            strategies: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive")[];
            /** Total */
            total: number;
        };
        /**
         * BatchRequest
         * @description What to run: each point of the sweep under each strategy.
         * @example {
         *       "scenario": {
         *         "road": {
         *           "length": 130,
         *           "bump": {
         *             "height": 0.08
         *           }
         *         },
         *         "speed": {
         *           "target_speed_kmh": 25
         *         }
         *       },
         *       "strategies": [
         *         "lqr",
         *         "passive"
         *       ],
         *       "sweep": {
         *         "grid": {
         *           "road.bump.height": [
         *             0.05,
         *             0.1
         *           ]
         *         }
         *       }
         *     }
         */
        BatchRequest: {
            /**
             * Dry Run
             * @description Only check and estimate: nothing is stored or computed
             * @default false
             */
            dry_run: boolean;
            /**
             * Label
             * @description A name for it, to find it again
             */
            label?: string | null;
            /**
             * @default {
             *       "vehicle": {
             *         "anti_dive": 0,
             *         "anti_lift": 0,
             *         "body_mass": 1270,
             *         "bump_stop_stiffness": 200000,
             *         "cg_height": 0.54,
             *         "cg_to_front": 1.015,
             *         "cg_to_rear": 1.895,
             *         "front_brake_share": 0.7,
             *         "front_damping": 6000,
             *         "front_spring": 27000,
             *         "front_tyre_stiffness": 268000,
             *         "front_wheel_mass": 66.3,
             *         "pitch_inertia": 1536.7,
             *         "rear_damping": 6000,
             *         "rear_spring": 30000,
             *         "rear_tyre_stiffness": 268000,
             *         "rear_wheel_mass": 66.3,
             *         "rebound_ratio": 1,
             *         "tyre_lift_off": false
             *       },
             *       "road": {
             *         "bump": {
             *           "count": 1,
             *           "height": 0.1,
             *           "shape": "cosine",
             *           "spacing": 10,
             *           "start": 100,
             *           "width": 4
             *         },
             *         "length": 150,
             *         "roughness": 0.000064,
             *         "seed": 1
             *       },
             *       "speed": {
             *         "controller": "guarded",
             *         "detection_distance": 80,
             *         "initial_speed_kmh": 50,
             *         "policy": "by_strategy",
             *         "target_speed_kmh": 22.5
             *       },
             *       "brake": {
             *         "brakes": 2,
             *         "drag_area": 0.65,
             *         "effective_radius": 0.13,
             *         "friction_coefficient": 0.38,
             *         "maximum_deceleration": 4,
             *         "piston_area": 0.0025,
             *         "pressure_lag": 0.1,
             *         "rolling_resistance": 0.012,
             *         "threshold_speed": 0.1,
             *         "wheel_radius": 0.3
             *       },
             *       "actuator": {},
             *       "mismatch": {
             *         "body_mass": 1,
             *         "damping": 1,
             *         "preview_delay": 0,
             *         "preview_gain": 1,
             *         "preview_noise": 0,
             *         "preview_offset": 0,
             *         "preview_resolution": 0,
             *         "rebound_ratio": 1,
             *         "springs": 1,
             *         "tyres": 1
             *       },
             *       "estimation": {
             *         "acceleration_noise": 0.05,
             *         "deflection_noise": 0.0005,
             *         "kind": "exact",
             *         "pitch_rate_noise": 0.002
             *       },
             *       "mpc": {
             *         "control_horizon": 20,
             *         "deflection_limit": 0.08,
             *         "deflection_weight": 3,
             *         "expected_noise": 0,
             *         "expected_offset": 0,
             *         "force_change_weight": 1e-10,
             *         "force_limit": 5000,
             *         "force_weight": 1e-9,
             *         "prediction_horizon": 30,
             *         "preview": "lookahead",
             *         "road_weights": {
             *           "bump": [
             *             3,
             *             1,
             *             6
             *           ],
             *           "rough": [
             *             8,
             *             1,
             *             1
             *           ]
             *         },
             *         "sample_time": 0.01,
             *         "solver": "daqp",
             *         "stage_weights": {
             *           "brake": [
             *             2,
             *             6,
             *             1
             *           ],
             *           "bump": [
             *             1,
             *             1,
             *             6
             *           ],
             *           "cruise": [
             *             8,
             *             1,
             *             1
             *           ]
             *         }
             *       },
             *       "lqr": {
             *         "deflection_weight": 3,
             *         "preview": "none",
             *         "preview_horizon": 30,
             *         "weights": [
             *           1,
             *           1,
             *           1
             *         ]
             *       },
             *       "hook": {
             *         "alpha": 0.5,
             *         "groundhook_damping": 2000,
             *         "semi_active": false,
             *         "skyhook_damping": 4000
             *       },
             *       "hil": {
             *         "bits": 12,
             *         "compensation": "predict",
             *         "iterations": 30,
             *         "jitter": 0,
             *         "noise": 0,
             *         "packet_loss": 0,
             *         "seed": 1
             *       }
             *     }
             */
            scenario: components["schemas"]["Scenario-Input"];
            /** Strategies */
            strategies: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive")[];
            sweep: components["schemas"]["Sweep"];
        };
        /**
         * BatchResults
         * @description Every run of a batch, in order.
         */
        BatchResults: {
            /** Batch */
            batch: string;
            /** Core Version */
            core_version: string;
            /** Rows */
            rows: components["schemas"]["BatchRow"][];
            /** Scenario */
            scenario: {
                [key: string]: unknown;
            };
            /** Sweep */
            sweep: {
                [key: string]: unknown;
            };
            /** Units */
            units: {
                [key: string]: string;
            };
        };
        /**
         * BatchRow
         * @description A run of a batch; further members are the swept fields by name and, of a run with status ok, its figures.
         */
        BatchRow: {
            /**
             * Fields
             * @description Which scenario fields make such a run cheaper
             */
            fields?: string[] | null;
            /**
             * Kind
             * @description `too-expensive` where a failed run would take more computing than one may
             */
            kind?: "too-expensive" | null;
            /**
             * Reason
             * @description Of a failed run
             */
            reason?: string | null;
            /** Run */
            run: number;
            /**
             * Status
             * @enum {string}
             */
            status: "ok" | "failed" | "waiting" | "cancelled";
            /**
             * Strategy
             * @enum {string}
             */
            strategy: "lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive";
        };
        /**
         * BatchSummary
         * @description What a batch's finished runs say as a whole.
         */
        BatchSummary: {
            /**
             * Baseline
             * @enum {string}
             */
            baseline: "lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive";
            /** Batch */
            batch: string;
            /**
             * Core Version
             * @description That computes `nominal` and `stability`; the rows' metrics are those of the versions rows name
             */
            core_version: string;
            /** Points */
            points: number;
            /**
             * Quantiles
             * @description Percentages of every list of quantiles below
             */
            quantiles: number[];
            /**
             * State
             * @enum {string}
             */
            state: "queued" | "running" | "done" | "cancelled" | "failed";
            /** Strategies */
            strategies: {
                [key: string]: components["schemas"]["StrategySummary"];
            };
            /** Units */
            units: {
                [key: string]: string;
            };
        };
        /**
         * BatchTable
         * @description A batch's rows column by column.
         */
        BatchTable: {
            /** Batch */
            batch: string;
            /** Columns */
            columns: {
                [key: string]: (number | string | boolean | number[] | null)[];
            };
            /**
             * State
             * @enum {string}
             */
            state: "queued" | "running" | "done" | "cancelled" | "failed";
            /** Units */
            units: {
                [key: string]: string;
            };
        };
        /**
         * Brake
         * @description Brake chain and driving resistances (Eq. 4-6); the paper gives no values: typical ones, ours.
         */
        Brake: {
            /**
             * Brakes
             * @description How many share the torque; one per axle of the half-car.
             * @default 2
             */
            brakes: number;
            /**
             * Drag area
             * @description Air drag coefficient times frontal area, c_d A.
             * @default 0.65
             */
            drag_area: number;
            /**
             * Effective disc radius
             * @description Friction radius r_b.
             * @default 0.13
             */
            effective_radius: number;
            /**
             * Pad friction
             * @description Coefficient µ; brake factor k = 2 µ.
             * @default 0.38
             */
            friction_coefficient: number;
            /**
             * Greatest deceleration
             * @description Top of the fuzzy controller's torque universe.
             * @default 4
             */
            maximum_deceleration: number;
            /**
             * Piston area
             * @description Contact area A of one brake.
             * @default 0.0025
             */
            piston_area: number;
            /**
             * Pressure lag
             * @description Time constant of the line pressure.
             * @default 0.1
             */
            pressure_lag: number;
            /**
             * Rolling resistance
             * @description Coefficient f_r.
             * @default 0.012
             */
            rolling_resistance: number;
            /**
             * Threshold speed
             * @description Sliding speed v_d of the smoothed friction.
             * @default 0.1
             */
            threshold_speed: number;
            /**
             * Wheel radius
             * @description Rolling radius.
             * @default 0.3
             */
            wheel_radius: number;
        };
        /**
         * Bump
         * @description The obstacle, or several alike in a row, added to the roughness (Eq. 2-3).
         */
        Bump: {
            /**
             * Bumps
             * @description How many alike in a row; they count as one bump, from the first to the last.
             * @default 1
             */
            count: number;
            /**
             * Height
             * @description Crest height; 0 is no bump, negative a pothole.
             * @default 0.1
             */
            height: number;
            /**
             * Shape
             * @description cosine is the paper's (Eq. 2); circular is a Watts hump; flat_top has half-cosine ramps, trapezoid straight ones, each a quarter of the width; kerb rises as half a cosine and stays up.
             * @default cosine
             * @enum {string}
             */
            shape: "cosine" | "half_sine" | "circular" | "flat_top" | "trapezoid" | "kerb";
            /**
             * Spacing
             * @description From the start of each to the next one's; cosines as far apart as they are wide are a washboard.
             * @default 10
             */
            spacing: number;
            /**
             * Position
             * @description Where the front axle meets it.
             * @default 100
             */
            start: number;
            /**
             * Width
             * @description Length along the road.
             * @default 4
             */
            width: number;
        };
        /**
         * CachedFailure
         * @description A failure, and whether it was computed for this request.
         */
        CachedFailure: {
            /** Cached */
            cached: boolean;
            /** Compute Ms */
            compute_ms: number;
            /**
             * Fields
             * @description Dotted names of scenario fields that make it cheaper
             * @default []
             */
            fields: string[];
            /**
             * Kind
             * @description `too-expensive` where the run would take more computing than one may: change one of `fields`
             * @default refused
             * @enum {string}
             */
            kind: "refused" | "too-expensive";
            /** Reason */
            reason: string;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            status: "failed";
        };
        /**
         * CachedResult
         * @description A result, and whether it was computed for this request.
         */
        CachedResult: {
            /**
             * Arrival Speed Kmh
             * @description [km/h]; the same on every road
             */
            arrival_speed_kmh: number;
            /**
             * Cached
             * @description Taken from store or memory, or from an equal request under way: not computed for this one
             */
            cached: boolean;
            /**
             * Comfort
             * @description Catalogue: comfort
             */
            comfort: {
                [key: string]: number;
            };
            /**
             * Compute Ms
             * @description The worker's own time [ms]; work shared between strategies counts once
             */
            compute_ms: number;
            /**
             * Events
             * @description Catalogue: events
             */
            events: {
                [key: string]: boolean | number | null;
            };
            /**
             * Metrics
             * @description By window (catalogue: windows)
             */
            metrics: {
                [key: string]: {
                    [key: string]: components["schemas"]["Statistics"];
                };
            };
            /**
             * Reference
             * @description Lines a plot draws; catalogue: references
             */
            reference: {
                [key: string]: number | null;
            };
            /** Stages */
            stages: components["schemas"]["Stage"][];
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            status: "ok";
            /**
             * Travel Time
             * @description [s]; the same on every road
             */
            travel_time: number;
        };
        /**
         * CachedRoadsResult
         * @description A result over several roads, and whether it was computed for this request.
         */
        CachedRoadsResult: {
            /**
             * Arrival Speed Kmh
             * @description [km/h]; the same on every road
             */
            arrival_speed_kmh: number;
            /**
             * Cached
             * @description No road was computed for this request
             */
            cached: boolean;
            /**
             * Comfort
             * @description Catalogue: comfort
             */
            comfort: {
                [key: string]: components["schemas"]["Interval"];
            };
            /**
             * Compute Ms
             * @description The worker's own time [ms]; work shared between strategies counts once
             */
            compute_ms: number;
            /**
             * Events
             * @description Catalogue: events
             */
            events: {
                [key: string]: boolean | number | null;
            };
            /**
             * Metrics
             * @description By window (catalogue: windows)
             */
            metrics: {
                [key: string]: {
                    [key: string]: components["schemas"]["RoadsStatistics"];
                };
            };
            /**
             * Reference
             * @description Lines a plot draws; catalogue: references
             */
            reference: {
                [key: string]: number | null;
            };
            /** Stages */
            stages: components["schemas"]["Stage"][];
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            status: "ok";
            /**
             * Travel Time
             * @description [s]; the same on every road
             */
            travel_time: number;
        };
        /**
         * Catalogue
         * @description Everything that has a name and a unit.
         */
        Catalogue: {
            /** Comfort */
            comfort: components["schemas"]["QuantityAnswer"][];
            /** Events */
            events: components["schemas"]["QuantityAnswer"][];
            /** Metric Signals */
            metric_signals: string[];
            /** Paper Signals */
            paper_signals: string[];
            /** References */
            references: components["schemas"]["QuantityAnswer"][];
            /** Run Figures */
            run_figures: components["schemas"]["QuantityAnswer"][];
            /** Signals */
            signals: components["schemas"]["QuantityAnswer"][];
            /** Stages */
            stages: components["schemas"]["QuantityAnswer"][];
            /** Statistics */
            statistics: components["schemas"]["QuantityAnswer"][];
            /** Windows */
            windows: components["schemas"]["QuantityAnswer"][];
        };
        /**
         * Cell
         * @description One printed change, and ours; absolutes in SI.
         */
        Cell: {
            /** Against */
            against: string;
            /**
             * Certain
             * @description The whole interval would get that verdict
             */
            certain: boolean | null;
            /**
             * Ci
             * @description 95 % interval [%]
             */
            ci: number[] | null;
            /** @description The verdict is then taken against `follows` */
            misprint: components["schemas"]["Misprint"] | null;
            /**
             * Our Base
             * @description Null while pending
             */
            our_base: number | null;
            /** Our Change */
            our_change: number | null;
            /**
             * Our Value
             * @description Null where the cell is unavailable
             */
            our_value: number | null;
            /** Paper Base */
            paper_base: number;
            /**
             * Paper Change
             * @description As printed [%]
             */
            paper_change: number;
            /** Paper Value */
            paper_value: number;
            /** Signal */
            signal: string;
            /** Statistic */
            statistic: string;
            /**
             * Strategy
             * @enum {string}
             */
            strategy: "lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive";
            /** Table */
            table: number;
            /**
             * Verdict
             * @enum {string}
             */
            verdict: "reached" | "smaller" | "contradicts" | "unavailable" | "pending";
            /** Window */
            window: string;
            /** @description Where a controller that looks ahead takes part */
            without_preview: components["schemas"]["Judgement"] | null;
        };
        /**
         * Change
         * @description Change of one combination against another [%].
         */
        Change: {
            /**
             * Ci
             * @description 95 % interval [%]
             */
            ci: number[];
            /** Our Change */
            our_change: number;
            /** Signal */
            signal: string;
            /** Statistic */
            statistic: string;
            /** Window */
            window: string;
        };
        /**
         * Changes
         * @description One signal in one window: paired change of the mean against the baseline's [%]; null where that is zero.
         */
        Changes: {
            peak: components["schemas"]["Interval"] | null;
            rms: components["schemas"]["Interval"] | null;
        };
        /**
         * Column
         * @description Who is compared with whom.
         */
        Column: {
            /** Against */
            against: string;
            /**
             * Strategy
             * @enum {string}
             */
            strategy: "lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive";
        };
        /**
         * CombinationRow
         * @description One combination of controller, speed, preview and weights.
         */
        CombinationRow: {
            /** Comfort */
            comfort: {
                [key: string]: components["schemas"]["Comfort"];
            };
            /**
             * Controller
             * @enum {string}
             */
            controller: "passive" | "lqr" | "mpc";
            /** Id */
            id: string;
            /**
             * Is
             * @description The paper's strategy it is
             */
            is: string | null;
            /** Label */
            label: string;
            /** Metrics */
            metrics: components["schemas"]["Figure8"][];
            /** Preview */
            preview: ("none" | "wheelbase" | "lookahead") | null;
            /**
             * Speed
             * @enum {string}
             */
            speed: "constant" | "planned";
            /**
             * Travel Time
             * @description [s]
             */
            travel_time: number;
            /** Weights */
            weights: ("equal" | "comfort" | "switched") | null;
        };
        /**
         * Comfort
         * @description Mean over the seeds and its interval.
         */
        Comfort: {
            /** High */
            high: number;
            /** Low */
            low: number;
            /** Value */
            value: number;
        };
        /**
         * ComparedFigure
         * @description A column of the comparison.
         */
        ComparedFigure: {
            /**
             * Key
             * @description objectives.0, limits.0, or a figure's name
             */
            key: string;
            /** Label */
            label: string;
            /** Unit */
            unit: string;
        };
        /**
         * ComparedPoint
         * @description One set of weights beside the paper's.
         */
        ComparedPoint: {
            /**
             * Failures
             * @description Roads it could not be run on; the figures leave them out
             */
            failures: string[];
            /**
             * Fresh
             * @description By figure over the validation roads
             */
            fresh: {
                [key: string]: components["schemas"]["TunedFigures"];
            };
            /**
             * Roles
             * @description paper, scenario, best.0 (of the first objective), knee
             */
            roles: string[];
            /**
             * Training
             * @description By the figures' keys, over the training roads
             */
            training: {
                [key: string]: components["schemas"]["TunedFigures"];
            };
            /** Trial */
            trial: number;
            /**
             * Verdict
             * @description One for each objective, on the validation roads against the paper's weights: whether the interval of the change lies below zero, above it, or holds it; null for the paper's own
             */
            verdict: ("better" | "worse" | "unclear")[] | null;
            /** Weights */
            weights: {
                [key: string]: number | string | number[];
            };
        };
        /**
         * Comparison
         * @description The paper's weights and the tuned ones over the training roads and over fresh ones.
         */
        Comparison: {
            /**
             * Batch
             * @description The batch whose rows give these figures
             */
            batch: string;
            /** Figures */
            figures: components["schemas"]["ComparedFigure"][];
            /**
             * Points
             * @description The paper's weights first
             */
            points: components["schemas"]["ComparedPoint"][];
        };
        /**
         * ControllerPart
         * @description The microcontroller.
         */
        ControllerPart: {
            /**
             * Clock
             * @description [Hz]
             */
            clock: number;
            /**
             * Flash
             * @description [bytes]
             */
            flash: number;
            /** Name */
            name: string;
            /**
             * Ram
             * @description [bytes]
             */
            ram: number;
            /**
             * Stack
             * @description Kept free for the controller's calls [bytes]
             */
            stack: number;
        };
        /**
         * ControllerReport
         * @description Whether the scenario's controller fits a small microcontroller, and what does; the scenario's own comes first.
         */
        ControllerReport: {
            /**
             * Cycles Per Operation
             * @description Measured by emulation of the part's processor
             */
            cycles_per_operation: number;
            part: components["schemas"]["ControllerPart"];
            /** Rows */
            rows: components["schemas"]["ControllerRow"][];
            /**
             * Sample Time
             * @description Between two steps [s]
             */
            sample_time: number;
            /**
             * Spread
             * @description Share by which the emulated cycles lie around that
             */
            spread: number;
        };
        /**
         * ControllerRequest
         * @description Whose controller; an omitted part of the scenario takes the paper's default.
         * @example {
         *       "scenario": {
         *         "road": {
         *           "length": 130,
         *           "bump": {
         *             "height": 0.08
         *           }
         *         },
         *         "speed": {
         *           "target_speed_kmh": 25
         *         }
         *       }
         *     }
         */
        ControllerRequest: {
            /**
             * @default {
             *       "vehicle": {
             *         "anti_dive": 0,
             *         "anti_lift": 0,
             *         "body_mass": 1270,
             *         "bump_stop_stiffness": 200000,
             *         "cg_height": 0.54,
             *         "cg_to_front": 1.015,
             *         "cg_to_rear": 1.895,
             *         "front_brake_share": 0.7,
             *         "front_damping": 6000,
             *         "front_spring": 27000,
             *         "front_tyre_stiffness": 268000,
             *         "front_wheel_mass": 66.3,
             *         "pitch_inertia": 1536.7,
             *         "rear_damping": 6000,
             *         "rear_spring": 30000,
             *         "rear_tyre_stiffness": 268000,
             *         "rear_wheel_mass": 66.3,
             *         "rebound_ratio": 1,
             *         "tyre_lift_off": false
             *       },
             *       "road": {
             *         "bump": {
             *           "count": 1,
             *           "height": 0.1,
             *           "shape": "cosine",
             *           "spacing": 10,
             *           "start": 100,
             *           "width": 4
             *         },
             *         "length": 150,
             *         "roughness": 0.000064,
             *         "seed": 1
             *       },
             *       "speed": {
             *         "controller": "guarded",
             *         "detection_distance": 80,
             *         "initial_speed_kmh": 50,
             *         "policy": "by_strategy",
             *         "target_speed_kmh": 22.5
             *       },
             *       "brake": {
             *         "brakes": 2,
             *         "drag_area": 0.65,
             *         "effective_radius": 0.13,
             *         "friction_coefficient": 0.38,
             *         "maximum_deceleration": 4,
             *         "piston_area": 0.0025,
             *         "pressure_lag": 0.1,
             *         "rolling_resistance": 0.012,
             *         "threshold_speed": 0.1,
             *         "wheel_radius": 0.3
             *       },
             *       "actuator": {},
             *       "mismatch": {
             *         "body_mass": 1,
             *         "damping": 1,
             *         "preview_delay": 0,
             *         "preview_gain": 1,
             *         "preview_noise": 0,
             *         "preview_offset": 0,
             *         "preview_resolution": 0,
             *         "rebound_ratio": 1,
             *         "springs": 1,
             *         "tyres": 1
             *       },
             *       "estimation": {
             *         "acceleration_noise": 0.05,
             *         "deflection_noise": 0.0005,
             *         "kind": "exact",
             *         "pitch_rate_noise": 0.002
             *       },
             *       "mpc": {
             *         "control_horizon": 20,
             *         "deflection_limit": 0.08,
             *         "deflection_weight": 3,
             *         "expected_noise": 0,
             *         "expected_offset": 0,
             *         "force_change_weight": 1e-10,
             *         "force_limit": 5000,
             *         "force_weight": 1e-9,
             *         "prediction_horizon": 30,
             *         "preview": "lookahead",
             *         "road_weights": {
             *           "bump": [
             *             3,
             *             1,
             *             6
             *           ],
             *           "rough": [
             *             8,
             *             1,
             *             1
             *           ]
             *         },
             *         "sample_time": 0.01,
             *         "solver": "daqp",
             *         "stage_weights": {
             *           "brake": [
             *             2,
             *             6,
             *             1
             *           ],
             *           "bump": [
             *             1,
             *             1,
             *             6
             *           ],
             *           "cruise": [
             *             8,
             *             1,
             *             1
             *           ]
             *         }
             *       },
             *       "lqr": {
             *         "deflection_weight": 3,
             *         "preview": "none",
             *         "preview_horizon": 30,
             *         "weights": [
             *           1,
             *           1,
             *           1
             *         ]
             *       },
             *       "hook": {
             *         "alpha": 0.5,
             *         "groundhook_damping": 2000,
             *         "semi_active": false,
             *         "skyhook_damping": 4000
             *       },
             *       "hil": {
             *         "bits": 12,
             *         "compensation": "predict",
             *         "iterations": 30,
             *         "jitter": 0,
             *         "noise": 0,
             *         "packet_loss": 0,
             *         "seed": 1
             *       }
             *     }
             */
            scenario: components["schemas"]["Scenario-Input"];
        };
        /**
         * ControllerRow
         * @description One controller, built for the part and driven over the scenario.
         */
        ControllerRow: {
            /**
             * Changes
             * @description Against `lv` simulated, by window and signal [%]: Tables 9 and 10's figures
             */
            changes: {
                [key: string]: {
                    [key: string]: number | null;
                };
            };
            /**
             * Checked
             * @description all limits of the horizon, or a few: the first move's forces and every third deflection
             * @enum {string}
             */
            checked: "all" | "few";
            /** Checked Rows */
            checked_rows: number;
            /**
             * Code
             * @description Flash, the compiler's arithmetic included [bytes]
             */
            code: number;
            /**
             * Constants
             * @description Flash: tables [bytes]
             */
            constants: number;
            /** Control Horizon */
            control_horizon: number;
            /** Fits */
            fits: boolean;
            /**
             * Iterations
             * @description Its solver stops after so many
             */
            iterations: number;
            /**
             * Most Iterations
             * @description That a step of this drive took
             */
            most_iterations: number;
            operations: components["schemas"]["Operations"];
            /** Prediction Horizon */
            prediction_horizon: number;
            /**
             * Reasons
             * @description Why it does not fit
             */
            reasons: string[];
            time: components["schemas"]["StepTime"];
            /**
             * Unfinished
             * @description Steps of this drive whose iterations ran out
             */
            unfinished: number;
            /**
             * Variables
             * @description RAM without the stack [bytes]
             */
            variables: number;
        };
        /**
         * Counts
         * @description How many cells got each verdict.
         */
        Counts: {
            /** Contradicts */
            contradicts: number;
            /** Reached */
            reached: number;
            /** Smaller */
            smaller: number;
        };
        /**
         * CreatedLink
         * @description A new link.
         */
        CreatedLink: {
            /**
             * Series Pinned
             * @description Whether the link stores time histories too. Never of a batch; of a run of another core version only where an earlier link pinned them. Metrics always are.
             */
            series_pinned: boolean;
            /**
             * Slug
             * @description 22 characters, 128 random bits
             */
            slug: string;
            /**
             * Url
             * @description Path of the page that opens it
             */
            url: string;
        };
        /**
         * CreatedRoad
         * @description A road that was uploaded.
         */
        CreatedRoad: {
            /**
             * Bumps
             * @description The largest first
             */
            bumps: components["schemas"]["FoundBumpAnswer"][];
            /**
             * Id
             * @description For `road.profile` of a scenario; equal heights have equal ids
             */
            id: string;
            /**
             * Length
             * @description Greatest `road.length` on it [m]
             */
            length: number;
            /**
             * Samples
             * @description Heights, 10 mm apart
             */
            samples: number;
            /**
             * Warnings
             * @description What was done to the file, and what may be wrong with it
             */
            warnings: string[];
        };
        /**
         * CreatedRoadsRun
         * @description The answer to the request that created a run over several roads.
         */
        CreatedRoadsRun: {
            /**
             * Baseline
             * @enum {string}
             */
            baseline: "lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive";
            /**
             * Changes
             * @description By strategy; not of the baseline, nor of failures
             */
            changes: {
                [key: string]: components["schemas"]["StrategyChanges"];
            };
            /** Core Version */
            core_version: string;
            /** Id */
            id: string;
            /**
             * Roads
             * @description Seeds road.seed, road.seed + 1, …; time histories and events are the first's
             */
            roads: number;
            scenario: components["schemas"]["Scenario-Output"];
            /**
             * Strategies
             * @description By strategy
             */
            strategies: {
                [key: string]: components["schemas"]["CachedRoadsResult"] | components["schemas"]["CachedFailure"];
            };
        };
        /**
         * CreatedRun
         * @description The answer to the request that created a run.
         */
        CreatedRun: {
            /** Core Version */
            core_version: string;
            /** Id */
            id: string;
            scenario: components["schemas"]["Scenario-Output"];
            /**
             * Strategies
             * @description By strategy
             */
            strategies: {
                [key: string]: components["schemas"]["CachedResult"] | components["schemas"]["CachedFailure"];
            };
        };
        /**
         * DataSheet
         * @description A whole car: what its axles weigh, how fast they swing and how well that is damped.
         * @example {
         *       "front_axle_load": 760,
         *       "rear_axle_load": 640,
         *       "front_axle_mass": 70,
         *       "rear_axle_mass": 60,
         *       "wheelbase": 2.6,
         *       "front_frequency": 1.2,
         *       "rear_frequency": 1.4,
         *       "front_damping_ratio": 0.25,
         *       "rear_damping_ratio": 0.3,
         *       "front_tyre_stiffness": 200000,
         *       "rear_tyre_stiffness": 200000
         *     }
         */
        DataSheet: {
            /**
             * Height of the centre of gravity
             * @description Of the body above the road.
             * @default 0.55
             */
            cg_height: number;
            /**
             * Front axle load
             * @description What both front wheels carry, wheels included.
             */
            front_axle_load: number;
            /**
             * Front unsprung mass
             * @description Both front wheels with what moves with them.
             */
            front_axle_mass: number;
            /**
             * Front damping ratio
             * @description Of that motion, over critical.
             */
            front_damping_ratio: number;
            /**
             * Front natural frequency
             * @description Of the body above the front axle, undamped, on suspension and tyres.
             */
            front_frequency: number;
            /**
             * Front tyre stiffness
             * @description Vertical stiffness of one tyre.
             */
            front_tyre_stiffness: number;
            /**
             * Pitch inertia
             * @description Of the whole body; none makes the dynamic index 1, mass times both distances of the centre of gravity.
             */
            pitch_inertia?: number | null;
            /**
             * Rear axle load
             * @description What both rear wheels carry, wheels included.
             */
            rear_axle_load: number;
            /**
             * Rear unsprung mass
             * @description Both rear wheels with what moves with them.
             */
            rear_axle_mass: number;
            /**
             * Rear damping ratio
             * @description Of that motion, over critical.
             */
            rear_damping_ratio: number;
            /**
             * Rear natural frequency
             * @description Of the body above the rear axle, undamped, on suspension and tyres.
             */
            rear_frequency: number;
            /**
             * Rear tyre stiffness
             * @description Vertical stiffness of one tyre.
             */
            rear_tyre_stiffness: number;
            /**
             * Wheelbase
             * @description Between the axles.
             */
            wheelbase: number;
        };
        /**
         * EqualSpeed
         * @description Two combinations with the same speed plan.
         */
        EqualSpeed: {
            /** Against */
            against: string;
            /** Cells */
            cells: components["schemas"]["Change"][];
            /** Label */
            label: string;
            /** Strategy */
            strategy: string;
        };
        /**
         * Erratum
         * @description What is printed and what is used here; Markdown in both.
         */
        Erratum: {
            /** Here */
            here: string;
            /** Place */
            place: string;
            /** Printed */
            printed: string;
        };
        /**
         * Estimate
         * @description The size and the estimated time of a batch.
         */
        Estimate: {
            /**
             * Contradictory
             * @description Runs whose fields contradict each other: they would be failed rows
             */
            contradictory: number;
            /**
             * Estimated Cost
             * @description Estimate, which is compared with the limit [s of one core]
             */
            estimated_cost: number;
            /**
             * Estimated Seconds
             * @description By some runs tried just now [s]; none where trying takes long
             */
            estimated_seconds: number | null;
            /**
             * Notes
             * @description What its runs do not depend on: fields a strategy does not read, and such
             */
            notes: string[];
            /** Points */
            points: number;
            /**
             * Total
             * @description Runs: points times strategies
             */
            total: number;
        };
        /**
         * Estimation
         * @description What controllers are told of the car's state: the state itself, or what a Kalman filter makes of sensors.
         */
        Estimation: {
            /**
             * Acceleration noise
             * @description Standard deviation of each measured acceleration of the body, and what the filter expects (kalman; ours).
             * @default 0.05
             */
            acceleration_noise: number;
            /**
             * Deflection noise
             * @description Standard deviation of each measured deflection, and what the filter expects (kalman; ours).
             * @default 0.0005
             */
            deflection_noise: number;
            /**
             * State
             * @description exact as in the paper; kalman: a steady-state filter on both deflections, the body's acceleration and the pitch rate, measured at each control instant.
             * @default exact
             * @enum {string}
             */
            kind: "exact" | "kalman";
            /**
             * Pitch rate noise
             * @description Standard deviation of each measured pitch rate, and what the filter expects (kalman; ours).
             * @default 0.002
             */
            pitch_rate_noise: number;
        };
        /**
         * Figure8
         * @description One of the eight figures of a combination, mean over the seeds and its interval; SI.
         */
        Figure8: {
            /**
             * Change Vs Passive
             * @description [%]
             */
            change_vs_passive: number;
            /** High */
            high: number;
            /** Low */
            low: number;
            /** Signal */
            signal: string;
            /** Statistic */
            statistic: string;
            /** Value */
            value: number;
            /** Window */
            window: string;
        };
        /**
         * Figures
         * @description Plotly figures by name, in the order of display.
         */
        Figures: {
            /** Figures */
            figures: {
                [key: string]: {
                    [key: string]: unknown;
                };
            };
        };
        /**
         * FigureSummary
         * @description One figure under one strategy; lower is better.
         */
        FigureSummary: {
            /**
             * Above Zero
             * @description Runs with more than 0, of figures such as travel exceeded
             */
            above_zero: number;
            highest: components["schemas"]["Place"] | null;
            lowest: components["schemas"]["Place"] | null;
            /** @description None for the baseline itself */
            margin: components["schemas"]["MarginSummary"] | null;
            /** Mean */
            mean: number | null;
            /** N */
            n: number;
            /**
             * Nominal
             * @description Of the batch's own scenario, nothing swept
             */
            nominal: number | null;
            /**
             * Quantiles
             * @description At the percentages in the answer's `quantiles`
             */
            quantiles: number[] | null;
            /** Sensitivity */
            sensitivity: components["schemas"]["Sensitivity"][];
        };
        /**
         * FoundBumpAnswer
         * @description A bump in the profile; with height 0 a scenario's bump there has the car brake for it, and nothing is added.
         */
        FoundBumpAnswer: {
            /**
             * Height
             * @description Above the road around it, negative in a pothole [m]
             */
            height: number;
            /**
             * Start
             * @description Where it begins [m]
             */
            start: number;
            /**
             * Width
             * @description [m]
             */
            width: number;
        };
        /**
         * Generation
         * @description How far the search was after a generation.
         */
        Generation: {
            /**
             * Best
             * @description Smallest feasible value of each objective so far
             */
            best: (number | null)[];
            /**
             * Feasible
             * @description So far
             */
            feasible: number;
            /** Generation */
            generation: number;
            /**
             * Hypervolume
             * @description Share of the box between zero and the paper's weights' values that the front dominates: with one objective how much smaller it got; null where the paper's value of an objective is zero or missing
             */
            hypervolume: number | null;
            /**
             * Trials
             * @description So far
             */
            trials: number;
        };
        /**
         * HalfCarAnswer
         * @description The half-car that a data sheet makes.
         */
        HalfCarAnswer: {
            vehicle: components["schemas"]["Vehicle"];
        };
        /**
         * Health
         * @description Liveness.
         */
        Health: {
            /**
             * Status
             * @constant
             */
            status: "ok";
        };
        /**
         * Hil
         * @description Hardware in the loop: the controller apart from the plant, as `lv_hil` drives it (section 4.2).
         */
        Hil: {
            /**
             * Converter bits
             * @description Resolution of every sensor and of the actuator commands.
             * @default 12
             */
            bits: number;
            /**
             * Delay compensation
             * @description A command takes effect one control step after its measurement: predict (ours) lets the ECU reckon the state ahead to that moment, none lets it answer the past.
             * @default predict
             * @enum {string}
             */
            compensation: "predict" | "none";
            /**
             * Iterations
             * @description The ECU's solver stops after so many, whatever it has.
             * @default 30
             */
            iterations: number;
            /**
             * Jitter
             * @description A command takes effect up to so much later still, evenly spread, in steps of 1 ms or a little less.
             * @default 0
             */
            jitter: number;
            /**
             * Sensor noise
             * @description Standard deviation as a share of each input's range, before the converter.
             * @default 0
             */
            noise: number;
            /**
             * Lost packets
             * @description Share of the commands that never arrive; the actuators hold the last one.
             * @default 0
             */
            packet_loss: number;
            /**
             * Seed
             * @description Of noise, jitter and losses.
             * @default 1
             */
            seed: number;
        };
        /**
         * Hook
         * @description Skyhook, groundhook and hybrid: dampers against sky and ground, beside the car's own (docs/physics.md).
         */
        Hook: {
            /**
             * Share of skyhook
             * @description Of hybrid; the rest is groundhook (ours).
             * @default 0.5
             */
            alpha: number;
            /**
             * Groundhook damping
             * @description Of each wheel (ours).
             * @default 2000
             */
            groundhook_damping: number;
            /**
             * Semi-active
             * @description The actuator only takes energy out, like a controlled damper: a force that would add some is 0.
             * @default false
             */
            semi_active: boolean;
            /**
             * Skyhook damping
             * @description Of the body over each axle (ours).
             * @default 4000
             */
            skyhook_damping: number;
        };
        /**
         * Interpretation
         * @description A named set of readings, and the counts of verdicts under it, on the same roads.
         */
        Interpretation: {
            agreement: components["schemas"]["Agreement"];
            /**
             * Changes
             * @description The scenario's fields it changes, by dotted name
             */
            changes: {
                [key: string]: unknown;
            };
            /**
             * Choices
             * @description Reading: choice, all of them
             */
            choices: {
                [key: string]: string;
            };
            counts: components["schemas"]["Counts"];
            /** Description */
            description: string;
            /** @description Hardware in the loop, by our rule of ±8 % */
            ecu: components["schemas"]["Part"];
            /** Id */
            id: string;
            /** Reached */
            reached: number;
            /** @description The changes we simulate */
            simulated: components["schemas"]["Part"];
            /** Title */
            title: string;
            /**
             * Total
             * @description Cells with a verdict
             */
            total: number;
        };
        /**
         * Interval
         * @description A mean over roads, or a change of means [%], with its 95 % interval (Student's t).
         */
        Interval: {
            /** High */
            high: number;
            /** Low */
            low: number;
            /** Mean */
            mean: number;
        };
        /**
         * Judgement
         * @description Our change [%] and what the paper's comes to; all but the verdict is null where the cell is unavailable.
         */
        Judgement: {
            /**
             * Certain
             * @description The whole interval would get that verdict
             */
            certain: boolean | null;
            /**
             * Ci
             * @description 95 % interval [%]
             */
            ci: number[] | null;
            /** Our Change */
            our_change: number | null;
            /**
             * Verdict
             * @enum {string}
             */
            verdict: "reached" | "smaller" | "contradicts" | "unavailable" | "pending";
        };
        /**
         * LabelRequest
         * @description A job's new label.
         * @example {
         *       "label": "winter"
         *     }
         */
        LabelRequest: {
            /**
             * Label
             * @description null takes its name away
             */
            label: string | null;
        };
        /**
         * LatinHypercube
         * @description Evenly spread random points (scipy.stats.qmc.LatinHypercube); whole-number fields get whole numbers.
         */
        LatinHypercube: {
            /**
             * Ranges
             * @description Field -> [lowest, highest]
             */
            ranges: {
                [key: string]: number[];
            };
            /** Samples */
            samples: number;
            /**
             * Seed
             * @description Same seed, same points
             * @default 0
             */
            seed: number;
        };
        /**
         * Limit
         * @description A figure that may not be exceeded on any training road.
         */
        Limit: {
            /** At Most */
            at_most: number;
            /**
             * Figure
             * @enum {string}
             */
            figure: "rough_road.body_acceleration.rms" | "rough_road.body_acceleration.peak" | "rough_road.pitch_acceleration.rms" | "rough_road.pitch_acceleration.peak" | "rough_road.front_tyre_load.rms" | "rough_road.front_tyre_load.peak" | "rough_road.rear_tyre_load.rms" | "rough_road.rear_tyre_load.peak" | "rough_road.front_deflection.rms" | "rough_road.front_deflection.peak" | "rough_road.rear_deflection.rms" | "rough_road.rear_deflection.peak" | "rough_road.front_force.rms" | "rough_road.front_force.peak" | "rough_road.rear_force.rms" | "rough_road.rear_force.peak" | "bump.body_acceleration.rms" | "bump.body_acceleration.peak" | "bump.pitch_acceleration.rms" | "bump.pitch_acceleration.peak" | "bump.front_tyre_load.rms" | "bump.front_tyre_load.peak" | "bump.rear_tyre_load.rms" | "bump.rear_tyre_load.peak" | "bump.front_deflection.rms" | "bump.front_deflection.peak" | "bump.rear_deflection.rms" | "bump.rear_deflection.peak" | "bump.front_force.rms" | "bump.front_force.peak" | "bump.rear_force.rms" | "bump.rear_force.peak" | "whole.body_acceleration.rms" | "whole.body_acceleration.peak" | "whole.pitch_acceleration.rms" | "whole.pitch_acceleration.peak" | "whole.front_tyre_load.rms" | "whole.front_tyre_load.peak" | "whole.rear_tyre_load.rms" | "whole.rear_tyre_load.peak" | "whole.front_deflection.rms" | "whole.front_deflection.peak" | "whole.rear_deflection.rms" | "whole.rear_deflection.peak" | "whole.front_force.rms" | "whole.front_force.peak" | "whole.rear_force.rms" | "whole.rear_force.peak" | "comfort.weighted_rms" | "comfort.vibration_dose" | "comfort.front_dynamic_load_coefficient" | "comfort.rear_dynamic_load_coefficient" | "comfort.actuator_mean_power" | "comfort.actuator_peak_power" | "events.airborne_ms" | "events.front_airborne_ms" | "events.rear_airborne_ms" | "events.travel_exceeded_mm" | "events.limited_steps" | "events.qp_solves" | "events.qp_fallbacks" | "events.qp_failures" | "events.max_slack_mm" | "events.ecu_most_iterations" | "events.ecu_clipped_values" | "events.ecu_held_commands" | "travel_time" | "arrival_speed_kmh";
        };
        /**
         * LimitAnswer
         * @description A limit with its name.
         */
        LimitAnswer: {
            /** At Most */
            at_most: number;
            /** Figure */
            figure: string;
            /** Label */
            label: string;
            /** Unit */
            unit: string;
        };
        /**
         * Link
         * @description The contents of a link.
         */
        Link: {
            batch: components["schemas"]["Batch"] | null;
            /**
             * Computed At
             * Format: date-time
             * @description When; of a batch that still runs, when it was accepted
             */
            computed_at: string;
            /**
             * Core Version
             * @description Which computed it
             */
            core_version: string;
            /**
             * Created At
             * Format: date-time
             * @description When the link was created
             */
            created_at: string;
            /**
             * Current Core Version
             * @description Which the service runs
             */
            current_core_version: string;
            /**
             * Kind
             * @enum {string}
             */
            kind: "run" | "batch";
            /** Run */
            run: components["schemas"]["Run"] | components["schemas"]["RoadsRun"] | null;
            scenario: components["schemas"]["Scenario-Output"];
            /**
             * Schema Version
             * @description Which the scenario was stored under; `scenario` is today's
             */
            schema_version: number;
            /** Series Pinned */
            series_pinned: boolean;
            /** Slug */
            slug: string;
            /** Url */
            url: string;
            /** @description As it was sent */
            view: components["schemas"]["LinkView"];
        };
        /**
         * LinkPin
         * @description A run that the shared one is compared with, by a name.
         */
        LinkPin: {
            /** Name */
            name: string;
            /** Run */
            run: string;
        };
        /**
         * LinkRequest
         * @description What to share: a stored run or a batch, and how it is looked at.
         * @example {
         *       "run_id": "AAAAAAAAAAAAAAAAAAAAAA",
         *       "view": {
         *         "baseline": "passive",
         *         "axis": "time"
         *       }
         *     }
         */
        LinkRequest: {
            /** Batch Id */
            batch_id?: string | null;
            /** Run Id */
            run_id?: string | null;
            /** @default {} */
            view: components["schemas"]["LinkView"];
        };
        /**
         * LinkView
         * @description How the page shows a run or a batch; for omitted members it uses its defaults. Answered as it was sent.
         */
        LinkView: {
            /**
             * Against
             * @description Of a batch only: the strategy that map is compared with.
             */
            against?: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive") | "none" | null;
            /**
             * Axis
             * @description What is on the x axis.
             */
            axis?: ("distance" | "time") | null;
            /**
             * Baseline
             * @description What changes in % are against.
             */
            baseline?: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive") | null;
            /**
             * Cursor
             * @description Place on the x axis, [m] or [s]; null is none.
             */
            cursor?: number | null;
            /**
             * Differences
             * @description Of a run only: whether plots show differences to what changes are against.
             */
            differences?: boolean | null;
            /**
             * Hidden
             * @description Of those shown, the ones switched off in the plots.
             */
            hidden?: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive")[] | null;
            /**
             * Pins
             * @description Of a run only: runs it is compared with. The link keeps them as it keeps its own.
             */
            pins?: components["schemas"]["LinkPin"][] | null;
            /**
             * Plot
             * @description Of a batch only: runs over a field, a metric over two fields, or one metric over another.
             */
            plot?: ("points" | "map" | "trade_off") | null;
            /**
             * Reference
             * @description Of a run only: of which pin, by its run, changes in % are against; null is the baseline.
             */
            reference?: string | null;
            /**
             * Strategies
             * @description Shown, in this order.
             */
            strategies?: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive")[] | null;
            /**
             * Strategy
             * @description Of a batch only: whose map it is.
             */
            strategy?: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive") | null;
            /**
             * Threshold
             * @description Of a batch only: where the map has a line, in the unit shown; `none` for no line.
             */
            threshold?: number | "none" | null;
            /**
             * Versus
             * @description Of a batch only: the metric on the x axis of a trade-off.
             */
            versus?: string | null;
            /**
             * X
             * @description Of a batch only: the field on the x axis, dotted.
             */
            x?: string | null;
            /**
             * Y
             * @description Of a batch only: the metric on the y axis, or of the map.
             */
            y?: string | null;
            /**
             * Zoom
             * @description Range of the x axis, [m] or [s]; null is all.
             */
            zoom?: [
                number,
                number
            ] | null;
        };
        /**
         * LiveRequest
         * @description A run while somebody drags: nothing is stored, the answer has time histories.
         * @example {
         *       "scenario": {
         *         "road": {
         *           "length": 130,
         *           "bump": {
         *             "height": 0.08
         *           }
         *         },
         *         "speed": {
         *           "target_speed_kmh": 25
         *         }
         *       },
         *       "strategies": [
         *         "lv"
         *       ],
         *       "points": 200,
         *       "signals": [
         *         "body_acceleration"
         *       ]
         *     }
         */
        LiveRequest: {
            /**
             * Points
             * @description About how many samples; peaks survive.
             * @default 800
             */
            points: number;
            /**
             * @default {
             *       "vehicle": {
             *         "anti_dive": 0,
             *         "anti_lift": 0,
             *         "body_mass": 1270,
             *         "bump_stop_stiffness": 200000,
             *         "cg_height": 0.54,
             *         "cg_to_front": 1.015,
             *         "cg_to_rear": 1.895,
             *         "front_brake_share": 0.7,
             *         "front_damping": 6000,
             *         "front_spring": 27000,
             *         "front_tyre_stiffness": 268000,
             *         "front_wheel_mass": 66.3,
             *         "pitch_inertia": 1536.7,
             *         "rear_damping": 6000,
             *         "rear_spring": 30000,
             *         "rear_tyre_stiffness": 268000,
             *         "rear_wheel_mass": 66.3,
             *         "rebound_ratio": 1,
             *         "tyre_lift_off": false
             *       },
             *       "road": {
             *         "bump": {
             *           "count": 1,
             *           "height": 0.1,
             *           "shape": "cosine",
             *           "spacing": 10,
             *           "start": 100,
             *           "width": 4
             *         },
             *         "length": 150,
             *         "roughness": 0.000064,
             *         "seed": 1
             *       },
             *       "speed": {
             *         "controller": "guarded",
             *         "detection_distance": 80,
             *         "initial_speed_kmh": 50,
             *         "policy": "by_strategy",
             *         "target_speed_kmh": 22.5
             *       },
             *       "brake": {
             *         "brakes": 2,
             *         "drag_area": 0.65,
             *         "effective_radius": 0.13,
             *         "friction_coefficient": 0.38,
             *         "maximum_deceleration": 4,
             *         "piston_area": 0.0025,
             *         "pressure_lag": 0.1,
             *         "rolling_resistance": 0.012,
             *         "threshold_speed": 0.1,
             *         "wheel_radius": 0.3
             *       },
             *       "actuator": {},
             *       "mismatch": {
             *         "body_mass": 1,
             *         "damping": 1,
             *         "preview_delay": 0,
             *         "preview_gain": 1,
             *         "preview_noise": 0,
             *         "preview_offset": 0,
             *         "preview_resolution": 0,
             *         "rebound_ratio": 1,
             *         "springs": 1,
             *         "tyres": 1
             *       },
             *       "estimation": {
             *         "acceleration_noise": 0.05,
             *         "deflection_noise": 0.0005,
             *         "kind": "exact",
             *         "pitch_rate_noise": 0.002
             *       },
             *       "mpc": {
             *         "control_horizon": 20,
             *         "deflection_limit": 0.08,
             *         "deflection_weight": 3,
             *         "expected_noise": 0,
             *         "expected_offset": 0,
             *         "force_change_weight": 1e-10,
             *         "force_limit": 5000,
             *         "force_weight": 1e-9,
             *         "prediction_horizon": 30,
             *         "preview": "lookahead",
             *         "road_weights": {
             *           "bump": [
             *             3,
             *             1,
             *             6
             *           ],
             *           "rough": [
             *             8,
             *             1,
             *             1
             *           ]
             *         },
             *         "sample_time": 0.01,
             *         "solver": "daqp",
             *         "stage_weights": {
             *           "brake": [
             *             2,
             *             6,
             *             1
             *           ],
             *           "bump": [
             *             1,
             *             1,
             *             6
             *           ],
             *           "cruise": [
             *             8,
             *             1,
             *             1
             *           ]
             *         }
             *       },
             *       "lqr": {
             *         "deflection_weight": 3,
             *         "preview": "none",
             *         "preview_horizon": 30,
             *         "weights": [
             *           1,
             *           1,
             *           1
             *         ]
             *       },
             *       "hook": {
             *         "alpha": 0.5,
             *         "groundhook_damping": 2000,
             *         "semi_active": false,
             *         "skyhook_damping": 4000
             *       },
             *       "hil": {
             *         "bits": 12,
             *         "compensation": "predict",
             *         "iterations": 30,
             *         "jitter": 0,
             *         "noise": 0,
             *         "packet_loss": 0,
             *         "seed": 1
             *       }
             *     }
             */
            scenario: components["schemas"]["Scenario-Input"];
            /**
             * Signals
             * @description Time and position always come; none is all.
             */
            signals?: ("time" | "position" | "speed" | "front_road" | "rear_road" | "brake_pressure" | "brake_deceleration" | "body_acceleration" | "pitch_acceleration" | "front_tyre_load" | "rear_tyre_load" | "front_deflection" | "rear_deflection" | "front_force" | "rear_force")[] | null;
            /** Strategies */
            strategies: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive")[];
        };
        /**
         * LiveResult
         * @description Figures and decimated time histories.
         */
        LiveResult: {
            /**
             * Arrival Speed Kmh
             * @description [km/h]; the same on every road
             */
            arrival_speed_kmh: number;
            /**
             * Cached
             * @description Taken from store or memory, or from an equal request under way: not computed for this one
             */
            cached: boolean;
            /**
             * Comfort
             * @description Catalogue: comfort
             */
            comfort: {
                [key: string]: number;
            };
            /**
             * Compute Ms
             * @description The worker's own time [ms]; work shared between strategies counts once
             */
            compute_ms: number;
            /**
             * Events
             * @description Catalogue: events
             */
            events: {
                [key: string]: boolean | number | null;
            };
            /**
             * Metrics
             * @description By window (catalogue: windows)
             */
            metrics: {
                [key: string]: {
                    [key: string]: components["schemas"]["Statistics"];
                };
            };
            /**
             * Reference
             * @description Lines a plot draws; catalogue: references
             */
            reference: {
                [key: string]: number | null;
            };
            /**
             * Series
             * @description The same samples for every signal; SI units
             */
            series: {
                [key: string]: components["schemas"]["TypedArray"];
            };
            /** Stages */
            stages: components["schemas"]["Stage"][];
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            status: "ok";
            /**
             * Travel Time
             * @description [s]; the same on every road
             */
            travel_time: number;
        };
        /**
         * LiveRun
         * @description A run that is not stored.
         */
        LiveRun: {
            /** Core Version */
            core_version: string;
            scenario: components["schemas"]["Scenario-Output"];
            /**
             * Strategies
             * @description By strategy
             */
            strategies: {
                [key: string]: components["schemas"]["LiveResult"] | components["schemas"]["CachedFailure"];
            };
        };
        /**
         * LoginRequest
         * @description A token, as the service's file has it.
         * @example {
         *       "token": "0d1c7a4be8f2915c3366a0f4c1be7fd20a93b1c5de44f708"
         *     }
         */
        LoginRequest: {
            /** Token */
            token: string;
        };
        /**
         * LoginState
         * @description Whether the service wants a token, and whose this request showed.
         */
        LoginState: {
            /**
             * Name
             * @description Of the token; null without one
             */
            name: string | null;
            /** Required */
            required: boolean;
        };
        /**
         * Lqr
         * @description Linear quadratic regulator (section 4.2.2: equal weights).
         */
        Lqr: {
            /**
             * Travel weight
             * @description q4 (ours); 0 as in Eq. 16, which has none.
             * @default 3
             */
            deflection_weight: number;
            /**
             * Preview
             * @description As the MPC's, by a feedforward that is optimal without limits; none is the paper's LQR.
             * @default none
             * @enum {string}
             */
            preview: "none" | "wheelbase" | "lookahead" | "obstacle";
            /**
             * Preview horizon
             * @description In steps; nothing is known beyond.
             * @default 30
             */
            preview_horizon: number;
            /**
             * Weights
             * @description Equal, as in the paper.
             * @default [
             *       1,
             *       1,
             *       1
             *     ]
             */
            weights: [
                number,
                number,
                number
            ];
        };
        /**
         * MarginSummary
         * @description Change against the baseline strategy at the same point [%], over the points where both have the figure.
         */
        MarginSummary: {
            /**
             * Better
             * @description Share of the pairs with a lower value than the baseline's
             */
            better: number | null;
            highest: components["schemas"]["Place"] | null;
            lowest: components["schemas"]["Place"] | null;
            /** Mean */
            mean: number | null;
            /** N */
            n: number;
            /**
             * Nominal
             * @description Of the batch's own scenario [%]
             */
            nominal: number | null;
            /**
             * Pairs
             * @description Points compared; `n` of them have a change, the others' baseline is 0
             */
            pairs: number;
            /**
             * Quantiles
             * @description At the percentages in the answer's `quantiles`
             */
            quantiles: number[] | null;
            /** Sensitivity */
            sensitivity: components["schemas"]["Sensitivity"][];
            /**
             * Worse
             * @description Share of the pairs with a higher one
             */
            worse: number | null;
        };
        /**
         * Mismatch
         * @description What the real car and the real sensors have other than the controllers believe; nothing by default.
         *
         *     The controllers, and the speed plan, go by `vehicle`; the car that is driven has these factors on top.
         */
        Mismatch: {
            /**
             * Body mass and pitch inertia
             * @description Real over believed, both alike: the load.
             * @default 1
             */
            body_mass: number;
            /**
             * Damping
             * @description Real over believed, both axles.
             * @default 1
             */
            damping: number;
            /**
             * Preview delay
             * @description Delay of what the sensors see (lookahead, obstacle).
             * @default 0
             */
            preview_delay: number;
            /**
             * Preview gain
             * @description Height seen over the true one (lookahead, obstacle).
             * @default 1
             */
            preview_gain: number;
            /**
             * Preview noise
             * @description Standard deviation of each height the sensors give, one each 10 mm of the road (lookahead).
             * @default 0
             */
            preview_noise: number;
            /**
             * Preview offset
             * @description The sensors place the road ahead so much too far away (lookahead, obstacle).
             * @default 0
             */
            preview_offset: number;
            /**
             * Preview resolution
             * @description Length of road over which the sensors average each height (lookahead, obstacle).
             * @default 0
             */
            preview_resolution: number;
            /**
             * Rebound over compression
             * @description Real over believed ratio, both dampers, at the same mean.
             * @default 1
             */
            rebound_ratio: number;
            /**
             * Spring stiffness
             * @description Real over believed, both axles.
             * @default 1
             */
            springs: number;
            /**
             * Tyre stiffness
             * @description Real over believed, both axles.
             * @default 1
             */
            tyres: number;
        };
        /**
         * Misprint
         * @description A printed change that does not follow from the absolutes printed beside it [%].
         */
        Misprint: {
            /** Follows */
            follows: number;
            /** Printed */
            printed: number;
        };
        /**
         * Mpc
         * @description Model predictive suspension control (Eq. 8-15, section 3.2.2).
         */
        Mpc: {
            /**
             * Control horizon
             * @description Nc, moves; at most Np.
             * @default 20
             */
            control_horizon: number;
            /**
             * Travel limit
             * @description Suspension deflection limit, soft (ours).
             * @default 0.08
             */
            deflection_limit: number;
            /**
             * Travel weight
             * @description q4 (ours); 0 as in Eq. 16, which has none.
             * @default 3
             */
            deflection_weight: number;
            /**
             * Expected preview noise
             * @description Standard deviation of the noise that the controllers, LQR too, expect of each height (lookahead).
             * @default 0
             */
            expected_noise: number;
            /**
             * Expected preview offset
             * @description Standard deviation of the offset that the controllers, LQR too, expect of the sensors: the more, the less of the roughness seen they trust (lookahead).
             * @default 0
             */
            expected_offset: number;
            /**
             * Force change weight
             * @description On the moves of the force (ours).
             * @default 1e-10
             */
            force_change_weight: number;
            /**
             * Force limit
             * @description Actuator limit, hard (ours); LQR has it too.
             * @default 5000
             */
            force_limit: number;
            /**
             * Force weight
             * @description R, keeps the cost strictly convex (ours).
             * @default 1e-9
             */
            force_weight: number;
            /**
             * Prediction horizon
             * @description Np, in steps.
             * @default 30
             */
            prediction_horizon: number;
            /**
             * Preview
             * @description What is known of the road ahead: nothing, what the front axle has passed (wheelbase), what the sensors see (lookahead), or the bump alone (obstacle).
             * @default lookahead
             * @enum {string}
             */
            preview: "none" | "wheelbase" | "lookahead" | "obstacle";
            /**
             * Single suspension control's weights per road
             * @default {
             *       "rough": [
             *         8,
             *         1,
             *         1
             *       ],
             *       "bump": [
             *         3,
             *         1,
             *         6
             *       ]
             *     }
             */
            road_weights: components["schemas"]["RoadWeights"];
            /**
             * Sample time
             * @description Control interval Ts (ours).
             * @default 0.01
             */
            sample_time: number;
            /**
             * QP solver
             * @description Used where a limit binds; the other is the fallback.
             * @default daqp
             * @enum {string}
             */
            solver: "daqp" | "osqp";
            /**
             * LV weights per driving stage
             * @default {
             *       "cruise": [
             *         8,
             *         1,
             *         1
             *       ],
             *       "brake": [
             *         2,
             *         6,
             *         1
             *       ],
             *       "bump": [
             *         1,
             *         1,
             *         6
             *       ]
             *     }
             */
            stage_weights: components["schemas"]["StageWeights"];
        };
        /**
         * Objective
         * @description What to make small, as its mean, or a quantile, over the training roads.
         *
         *     `paper` is Eq. 16: q1 (a/a_p)² + q2 (r/r_p)² + q3 (F/F_p)² of the RMS of body and pitch acceleration and tyre load
         *     (both tyres) over the passive car's on the same road; `peaks` the same with peaks; `figure` one figure of a run.
         */
        Objective: {
            /**
             * Figure
             * @description Of figure: a name of a batch's columns
             */
            figure?: ("rough_road.body_acceleration.rms" | "rough_road.body_acceleration.peak" | "rough_road.pitch_acceleration.rms" | "rough_road.pitch_acceleration.peak" | "rough_road.front_tyre_load.rms" | "rough_road.front_tyre_load.peak" | "rough_road.rear_tyre_load.rms" | "rough_road.rear_tyre_load.peak" | "rough_road.front_deflection.rms" | "rough_road.front_deflection.peak" | "rough_road.rear_deflection.rms" | "rough_road.rear_deflection.peak" | "rough_road.front_force.rms" | "rough_road.front_force.peak" | "rough_road.rear_force.rms" | "rough_road.rear_force.peak" | "bump.body_acceleration.rms" | "bump.body_acceleration.peak" | "bump.pitch_acceleration.rms" | "bump.pitch_acceleration.peak" | "bump.front_tyre_load.rms" | "bump.front_tyre_load.peak" | "bump.rear_tyre_load.rms" | "bump.rear_tyre_load.peak" | "bump.front_deflection.rms" | "bump.front_deflection.peak" | "bump.rear_deflection.rms" | "bump.rear_deflection.peak" | "bump.front_force.rms" | "bump.front_force.peak" | "bump.rear_force.rms" | "bump.rear_force.peak" | "whole.body_acceleration.rms" | "whole.body_acceleration.peak" | "whole.pitch_acceleration.rms" | "whole.pitch_acceleration.peak" | "whole.front_tyre_load.rms" | "whole.front_tyre_load.peak" | "whole.rear_tyre_load.rms" | "whole.rear_tyre_load.peak" | "whole.front_deflection.rms" | "whole.front_deflection.peak" | "whole.rear_deflection.rms" | "whole.rear_deflection.peak" | "whole.front_force.rms" | "whole.front_force.peak" | "whole.rear_force.rms" | "whole.rear_force.peak" | "comfort.weighted_rms" | "comfort.vibration_dose" | "comfort.front_dynamic_load_coefficient" | "comfort.rear_dynamic_load_coefficient" | "comfort.actuator_mean_power" | "comfort.actuator_peak_power" | "events.airborne_ms" | "events.front_airborne_ms" | "events.rear_airborne_ms" | "events.travel_exceeded_mm" | "events.limited_steps" | "events.qp_solves" | "events.qp_fallbacks" | "events.qp_failures" | "events.max_slack_mm" | "events.ecu_most_iterations" | "events.ecu_clipped_values" | "events.ecu_held_commands" | "travel_time" | "arrival_speed_kmh") | null;
            /**
             * Kind
             * @enum {string}
             */
            kind: "paper" | "peaks" | "figure";
            /**
             * Q
             * @description Of paper and peaks: q1 body acceleration, q2 pitch acceleration, q3 tyre load
             * @default [
             *       1,
             *       1,
             *       1
             *     ]
             */
            q: [
                number,
                number,
                number
            ];
            /**
             * Window
             * @description Of paper (without one whole) and peaks (bump)
             * @enum {unknown}
             */
            window?: "rough_road" | "bump" | "whole" | null;
        };
        /**
         * ObjectiveAnswer
         * @description An objective with its name; `window` is never null for `paper` and `peaks`.
         */
        ObjectiveAnswer: {
            /** Figure */
            figure: string | null;
            /**
             * Kind
             * @enum {string}
             */
            kind: "paper" | "peaks" | "figure";
            /** Label */
            label: string;
            /** Q */
            q: number[];
            /** Unit */
            unit: string;
            /** Window */
            window: string | null;
        };
        /**
         * Operations
         * @description Floating-point operations of one step: a multiplication with its addition is one.
         */
        Operations: {
            /**
             * Least
             * @description In this drive; where no limit binds
             */
            least: number;
            /**
             * Most
             * @description In this drive
             */
            most: number;
        };
        /**
         * PairedChanges
         * @description What a run over several roads changes against another one over the same roads.
         */
        PairedChanges: {
            /**
             * Against
             * @description Id of the other run
             */
            against: string;
            /**
             * Changes
             * @description By strategy that succeeded in both: against the same strategy of the other run
             */
            changes: {
                [key: string]: components["schemas"]["StrategyChanges"];
            };
            /** Roads */
            roads: number;
        };
        /**
         * PaperAnswer
         * @description The paper's changes against ours.
         */
        PaperAnswer: {
            agreement: components["schemas"]["Agreement"];
            /** Cells */
            cells: components["schemas"]["Cell"][];
            /**
             * Complete
             * @description False in a partial answer whose other cells are being computed: ask again
             */
            complete: boolean;
            /** Core Version */
            core_version: string;
            counts: components["schemas"]["Counts"];
            /** @description Hardware in the loop, by our rule of ±8 % */
            ecu: components["schemas"]["Part"];
            /** Errata */
            errata: components["schemas"]["Erratum"][];
            /** First Seed */
            first_seed: number;
            /**
             * Interpretation
             * @description The named set whose readings these are; null where none has them
             */
            interpretation: string | null;
            /**
             * Interpretations
             * @description The named sets
             */
            interpretations: components["schemas"]["Interpretation"][];
            progress: components["schemas"]["Progress"];
            /** Reached */
            reached: number;
            /** Readings */
            readings: components["schemas"]["ReadingAnswer"][];
            /** Rules */
            rules: {
                [key: string]: string;
            };
            scenario: components["schemas"]["Scenario-Output"];
            /** Seeds */
            seeds: number;
            /** @description The changes we simulate */
            simulated: components["schemas"]["Part"];
            /** Tables */
            tables: components["schemas"]["TableAnswer"][];
            /**
             * Total
             * @description Cells with a verdict
             */
            total: number;
            unavailable: components["schemas"]["Unavailable"] | null;
            without_preview: components["schemas"]["WithoutPreview"];
        };
        /**
         * PaperFigure
         * @description One of the paper's figures, drawn from our runs.
         */
        PaperFigure: {
            /** Caption */
            caption: string;
            /**
             * Figure
             * @description Plotly: data and layout
             */
            figure: {
                [key: string]: unknown;
            };
            /** Number */
            number: number;
            /** Title */
            title: string;
        };
        /**
         * PaperFigures
         * @description Figures 3-6, 8, 10-17 and 19-22.
         */
        PaperFigures: {
            /** Figures */
            figures: components["schemas"]["PaperFigure"][];
        };
        /**
         * Part
         * @description A part of the cells.
         */
        Part: {
            /** Reached */
            reached: number;
            /**
             * Total
             * @description Cells with a verdict
             */
            total: number;
        };
        /**
         * Place
         * @description A run, its value, and the swept fields' values there.
         */
        Place: {
            /** At */
            at: {
                [key: string]: number | string | boolean | number[] | null;
            };
            /** Run */
            run: number;
            /** Value */
            value: number;
        };
        /**
         * PresetAnswer
         * @description A named scenario.
         */
        PresetAnswer: {
            /** Description */
            description: string;
            /** Id */
            id: string;
            /** Label */
            label: string;
            scenario: components["schemas"]["Scenario-Output"];
        };
        /**
         * Problem
         * @description RFC 9457; docs/api.md lists the kinds.
         * @example {
         *       "detail": "The request has values that cannot be used; errors names each.",
         *       "errors": [
         *         {
         *           "message": "Unknown field grids, perhaps grid; there are grid, latin_hypercube, list",
         *           "pointer": "/sweep/grids"
         *         }
         *       ],
         *       "request_id": "9b2d1f0c6e7a4f7c8f4f4f0c2f1f9a10",
         *       "status": 422,
         *       "title": "Invalid request",
         *       "type": "urn:problem-type:ridelab:invalid-request"
         *     }
         */
        Problem: {
            /** Detail */
            detail: string;
            /** Errors */
            errors: components["schemas"]["ProblemPlace"][];
            /**
             * Request Id
             * @description Also in the header X-Request-ID and in the service's log
             */
            request_id: string;
            /** Status */
            status: number;
            /**
             * Title
             * @description Of every problem of that type the same
             */
            title: string;
            /**
             * Type
             * @enum {string}
             */
            type: "urn:problem-type:ridelab:malformed-request" | "urn:problem-type:ridelab:two-lengths" | "urn:problem-type:ridelab:token-required" | "urn:problem-type:ridelab:forbidden" | "urn:problem-type:ridelab:cross-site" | "urn:problem-type:ridelab:other-token" | "urn:problem-type:ridelab:not-found" | "urn:problem-type:ridelab:method-not-allowed" | "urn:problem-type:ridelab:slow-body" | "urn:problem-type:ridelab:slow-head" | "urn:problem-type:ridelab:idempotency-key-reused" | "urn:problem-type:ridelab:not-ended" | "urn:problem-type:ridelab:done" | "urn:problem-type:ridelab:not-deletable" | "urn:problem-type:ridelab:other-core-version" | "urn:problem-type:ridelab:road-gone" | "urn:problem-type:ridelab:too-long" | "urn:problem-type:ridelab:address-too-long" | "urn:problem-type:ridelab:unsupported-media-type" | "urn:problem-type:ridelab:other-host" | "urn:problem-type:ridelab:invalid-request" | "urn:problem-type:ridelab:refused" | "urn:problem-type:ridelab:unknown" | "urn:problem-type:ridelab:cost-limit" | "urn:problem-type:ridelab:too-expensive" | "urn:problem-type:ridelab:no-solution" | "urn:problem-type:ridelab:strict-json" | "urn:problem-type:ridelab:too-many-requests" | "urn:problem-type:ridelab:headers-too-long" | "urn:problem-type:ridelab:internal-error" | "urn:problem-type:ridelab:unavailable" | "urn:problem-type:ridelab:full" | "urn:problem-type:ridelab:connections" | "urn:problem-type:ridelab:store-unavailable" | "urn:problem-type:ridelab:worker-lost" | "urn:problem-type:ridelab:newer-schema" | "urn:problem-type:ridelab:ecu-unavailable" | "urn:problem-type:ridelab:not-built";
        };
        /**
         * ProblemPlace
         * @description One value that cannot be used: a JSON pointer into the body, or a query parameter's name.
         */
        ProblemPlace: {
            /** Message */
            message: string;
            /** Parameter */
            parameter?: string | null;
            /** Pointer */
            pointer: string;
        };
        /**
         * Progress
         * @description How many of the runs behind the cells are stored.
         */
        Progress: {
            /** Done */
            done: number;
            /** Total */
            total: number;
        };
        /**
         * QuantityAnswer
         * @description One named quantity; unit `1` for none.
         */
        QuantityAnswer: {
            /** Description */
            description: string;
            /** Key */
            key: string;
            /** Label */
            label: string;
            /**
             * Notable
             * @description From this size on an event is worth a warning; 0 for what warns of nothing
             */
            notable: number;
            /** Symbol */
            symbol: string;
            /** Unit */
            unit: string;
        };
        /**
         * Readiness
         * @description Readiness, part by part.
         */
        Readiness: {
            /**
             * Status
             * @enum {string}
             */
            status: "ready" | "starting";
            /** Store */
            store: boolean;
            /** Workers */
            workers: boolean;
        };
        /**
         * ReadingAnswer
         * @description A question that the paper leaves open, and the choice made.
         */
        ReadingAnswer: {
            /** Choices */
            choices: components["schemas"]["ReadingChoice"][];
            /** Chosen */
            chosen: string;
            /** Description */
            description: string;
            /** Id */
            id: string;
            /** Title */
            title: string;
        };
        /**
         * ReadingChoice
         * @description One choice of a reading.
         */
        ReadingChoice: {
            /** Default */
            default: boolean;
            /** Id */
            id: string;
            /** Label */
            label: string;
            /**
             * Source
             * @description The sentence or equation of the paper that has it, or `ours`
             */
            source: string;
        };
        /**
         * ReadingRow
         * @description What one switch does, all others as they are by default.
         */
        ReadingRow: {
            /**
             * Changed
             * @description Cells whose verdict is another than by default
             */
            changed: number;
            /** Choice */
            choice: string;
            counts: components["schemas"]["Counts"];
            /** Reached */
            reached: number;
            /** Reading */
            reading: string;
            /**
             * Total
             * @description Cells with a verdict
             */
            total: number;
        };
        /**
         * ReadingsAnswer
         * @description Every switch by itself; `complete` is false while rows are still being computed: ask again.
         */
        ReadingsAnswer: {
            /** Complete */
            complete: boolean;
            /** Rows */
            rows: components["schemas"]["ReadingRow"][];
            unavailable: components["schemas"]["Unavailable"] | null;
        };
        /**
         * RealtimeReport
         * @description A drive by the clock of this machine, an ordinary operating system: not a control unit's figures.
         */
        RealtimeReport: {
            /**
             * Changes
             * @description Against the same drive in lock-step [%], by window and signal
             */
            changes: {
                [key: string]: {
                    [key: string]: number | null;
                };
            };
            /** @description The program's own time for a step */
            computing: components["schemas"]["Times"] | null;
            /**
             * Deadline
             * @description The sample time [s]
             */
            deadline: number;
            /** @description From frame to answer, where it was in time; null where none was */
            latency: components["schemas"]["Times"] | null;
            /**
             * Misses
             * @description Answers that came after it: the actuators held the last command
             */
            misses: number;
            /** Steps */
            steps: number;
            /** @description How late the plant itself was woken: jitter */
            wake_up: components["schemas"]["Times"];
        };
        /**
         * Road
         * @description Rough road made in space by ISO 8608, or a measured one, with bumps (section 2.1).
         */
        "Road-Input": {
            /**
             * @default {
             *       "shape": "cosine",
             *       "height": 0.1,
             *       "width": 4,
             *       "start": 100,
             *       "count": 1,
             *       "spacing": 10
             *     }
             */
            bump: components["schemas"]["Bump"];
            /**
             * Length
             * @description The run ends when the front axle gets here. The paper's road ends at 110 m; ours lets the car settle.
             * @default 150
             */
            length: number;
            /**
             * Measured profile
             * @description Id of a measured road, in place of one made from roughness and seed. Its file is CSV with distance [m] and height [mm] in its header, or left [mm] and right [mm].
             */
            profile?: string | null;
            /**
             * Roughness
             * @description Displacement PSD Gd(n0) at n0 = 0.1 1/m; or a class of ISO 8608 by its name, A to H, for its mean: A 16e-6, B 64e-6, C 256e-6, D 1024e-6, …; 0 is smooth.
             * @default 0.000064
             */
            roughness: number | ("A" | "B" | "C" | "D" | "E" | "F" | "G" | "H");
            /**
             * Seed
             * @description Same seed, same road.
             * @default 1
             */
            seed: number;
        };
        /**
         * Road
         * @description Rough road made in space by ISO 8608, or a measured one, with bumps (section 2.1).
         */
        "Road-Output": {
            /**
             * @default {
             *       "shape": "cosine",
             *       "height": 0.1,
             *       "width": 4,
             *       "start": 100,
             *       "count": 1,
             *       "spacing": 10
             *     }
             */
            bump: components["schemas"]["Bump"];
            /**
             * Length
             * @description The run ends when the front axle gets here. The paper's road ends at 110 m; ours lets the car settle.
             * @default 150
             */
            length: number;
            /**
             * Measured profile
             * @description Id of a measured road, in place of one made from roughness and seed. Its file is CSV with distance [m] and height [mm] in its header, or left [mm] and right [mm].
             */
            profile?: string | null;
            /**
             * Roughness
             * @description Displacement PSD Gd(n0) at n0 = 0.1 1/m; or a class of ISO 8608 by its name, A to H, for its mean: A 16e-6, B 64e-6, C 256e-6, D 1024e-6, …; 0 is smooth.
             * @default 0.000064
             */
            roughness: number;
            /**
             * Seed
             * @description Same seed, same road.
             * @default 1
             */
            seed: number;
        };
        /**
         * RoadAnswer
         * @description A road with its heights.
         */
        RoadAnswer: {
            /**
             * Bumps
             * @description The largest first
             */
            bumps: components["schemas"]["FoundBumpAnswer"][];
            /**
             * Distance
             * @description About as many as asked for, peaks among them [m]
             */
            distance: number[];
            /**
             * Height
             * @description There [m]
             */
            height: number[];
            /**
             * Id
             * @description For `road.profile` of a scenario; equal heights have equal ids
             */
            id: string;
            /**
             * Length
             * @description Greatest `road.length` on it [m]
             */
            length: number;
            /**
             * Samples
             * @description Heights, 10 mm apart
             */
            samples: number;
        };
        /**
         * RoadsResult
         * @description One strategy's figures over several roads.
         */
        RoadsResult: {
            /**
             * Arrival Speed Kmh
             * @description [km/h]; the same on every road
             */
            arrival_speed_kmh: number;
            /**
             * Comfort
             * @description Catalogue: comfort
             */
            comfort: {
                [key: string]: components["schemas"]["Interval"];
            };
            /**
             * Compute Ms
             * @description The worker's own time [ms]; work shared between strategies counts once
             */
            compute_ms: number;
            /**
             * Events
             * @description Catalogue: events
             */
            events: {
                [key: string]: boolean | number | null;
            };
            /**
             * Metrics
             * @description By window (catalogue: windows)
             */
            metrics: {
                [key: string]: {
                    [key: string]: components["schemas"]["RoadsStatistics"];
                };
            };
            /**
             * Reference
             * @description Lines a plot draws; catalogue: references
             */
            reference: {
                [key: string]: number | null;
            };
            /** Stages */
            stages: components["schemas"]["Stage"][];
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            status: "ok";
            /**
             * Travel Time
             * @description [s]; the same on every road
             */
            travel_time: number;
        };
        /**
         * RoadsRun
         * @description A stored run over several roads; it never changes.
         */
        RoadsRun: {
            /**
             * Baseline
             * @enum {string}
             */
            baseline: "lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive";
            /**
             * Changes
             * @description By strategy; not of the baseline, nor of failures
             */
            changes: {
                [key: string]: components["schemas"]["StrategyChanges"];
            };
            /** Core Version */
            core_version: string;
            /** Id */
            id: string;
            /**
             * Roads
             * @description Seeds road.seed, road.seed + 1, …; time histories and events are the first's
             */
            roads: number;
            scenario: components["schemas"]["Scenario-Output"];
            /**
             * Strategies
             * @description By strategy
             */
            strategies: {
                [key: string]: components["schemas"]["RoadsResult"] | components["schemas"]["StrategyFailure"];
            };
        };
        /**
         * RoadsStatistics
         * @description One signal in one window, over several roads.
         */
        RoadsStatistics: {
            peak: components["schemas"]["Interval"];
            rms: components["schemas"]["Interval"];
        };
        /**
         * RoadWeights
         * @description Single suspension control's weights per road (Table 3).
         */
        RoadWeights: {
            /**
             * Bump
             * @description Bumpy pavement.
             * @default [
             *       3,
             *       1,
             *       6
             *     ]
             */
            bump: [
                number,
                number,
                number
            ];
            /**
             * Rough road
             * @description Class B pavement.
             * @default [
             *       8,
             *       1,
             *       1
             *     ]
             */
            rough: [
                number,
                number,
                number
            ];
        };
        /**
         * RobustnessDefaults
         * @description The uncertain fields of a robustness study by default.
         */
        RobustnessDefaults: {
            /**
             * Baseline
             * @enum {string}
             */
            baseline: "lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive";
            /** Figures */
            figures: string[];
            /** Ranges */
            ranges: components["schemas"]["UncertainRange"][];
            /** Samples */
            samples: number;
            /** Strategies */
            strategies: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive")[];
        };
        /**
         * Run
         * @description A stored run; it never changes.
         */
        Run: {
            /** Core Version */
            core_version: string;
            /** Id */
            id: string;
            scenario: components["schemas"]["Scenario-Output"];
            /**
             * Strategies
             * @description By strategy
             */
            strategies: {
                [key: string]: components["schemas"]["StrategyResult"] | components["schemas"]["StrategyFailure"];
            };
        };
        /**
         * RunRequest
         * @description What to run, on how many roads.
         * @example {
         *       "scenario": {
         *         "road": {
         *           "length": 130,
         *           "bump": {
         *             "height": 0.08
         *           }
         *         },
         *         "speed": {
         *           "target_speed_kmh": 25
         *         }
         *       },
         *       "strategies": [
         *         "lv",
         *         "passive"
         *       ]
         *     }
         */
        RunRequest: {
            /**
             * Baseline
             * @description What the changes over several roads refer to, one of the strategies; null is passive, or the first strategy where passive does not run
             */
            baseline?: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive") | null;
            /**
             * Roads
             * @description Seeds road.seed, road.seed + 1, …; each strategy drives all
             * @default 1
             */
            roads: number;
            /**
             * @default {
             *       "vehicle": {
             *         "anti_dive": 0,
             *         "anti_lift": 0,
             *         "body_mass": 1270,
             *         "bump_stop_stiffness": 200000,
             *         "cg_height": 0.54,
             *         "cg_to_front": 1.015,
             *         "cg_to_rear": 1.895,
             *         "front_brake_share": 0.7,
             *         "front_damping": 6000,
             *         "front_spring": 27000,
             *         "front_tyre_stiffness": 268000,
             *         "front_wheel_mass": 66.3,
             *         "pitch_inertia": 1536.7,
             *         "rear_damping": 6000,
             *         "rear_spring": 30000,
             *         "rear_tyre_stiffness": 268000,
             *         "rear_wheel_mass": 66.3,
             *         "rebound_ratio": 1,
             *         "tyre_lift_off": false
             *       },
             *       "road": {
             *         "bump": {
             *           "count": 1,
             *           "height": 0.1,
             *           "shape": "cosine",
             *           "spacing": 10,
             *           "start": 100,
             *           "width": 4
             *         },
             *         "length": 150,
             *         "roughness": 0.000064,
             *         "seed": 1
             *       },
             *       "speed": {
             *         "controller": "guarded",
             *         "detection_distance": 80,
             *         "initial_speed_kmh": 50,
             *         "policy": "by_strategy",
             *         "target_speed_kmh": 22.5
             *       },
             *       "brake": {
             *         "brakes": 2,
             *         "drag_area": 0.65,
             *         "effective_radius": 0.13,
             *         "friction_coefficient": 0.38,
             *         "maximum_deceleration": 4,
             *         "piston_area": 0.0025,
             *         "pressure_lag": 0.1,
             *         "rolling_resistance": 0.012,
             *         "threshold_speed": 0.1,
             *         "wheel_radius": 0.3
             *       },
             *       "actuator": {},
             *       "mismatch": {
             *         "body_mass": 1,
             *         "damping": 1,
             *         "preview_delay": 0,
             *         "preview_gain": 1,
             *         "preview_noise": 0,
             *         "preview_offset": 0,
             *         "preview_resolution": 0,
             *         "rebound_ratio": 1,
             *         "springs": 1,
             *         "tyres": 1
             *       },
             *       "estimation": {
             *         "acceleration_noise": 0.05,
             *         "deflection_noise": 0.0005,
             *         "kind": "exact",
             *         "pitch_rate_noise": 0.002
             *       },
             *       "mpc": {
             *         "control_horizon": 20,
             *         "deflection_limit": 0.08,
             *         "deflection_weight": 3,
             *         "expected_noise": 0,
             *         "expected_offset": 0,
             *         "force_change_weight": 1e-10,
             *         "force_limit": 5000,
             *         "force_weight": 1e-9,
             *         "prediction_horizon": 30,
             *         "preview": "lookahead",
             *         "road_weights": {
             *           "bump": [
             *             3,
             *             1,
             *             6
             *           ],
             *           "rough": [
             *             8,
             *             1,
             *             1
             *           ]
             *         },
             *         "sample_time": 0.01,
             *         "solver": "daqp",
             *         "stage_weights": {
             *           "brake": [
             *             2,
             *             6,
             *             1
             *           ],
             *           "bump": [
             *             1,
             *             1,
             *             6
             *           ],
             *           "cruise": [
             *             8,
             *             1,
             *             1
             *           ]
             *         }
             *       },
             *       "lqr": {
             *         "deflection_weight": 3,
             *         "preview": "none",
             *         "preview_horizon": 30,
             *         "weights": [
             *           1,
             *           1,
             *           1
             *         ]
             *       },
             *       "hook": {
             *         "alpha": 0.5,
             *         "groundhook_damping": 2000,
             *         "semi_active": false,
             *         "skyhook_damping": 4000
             *       },
             *       "hil": {
             *         "bits": 12,
             *         "compensation": "predict",
             *         "iterations": 30,
             *         "jitter": 0,
             *         "noise": 0,
             *         "packet_loss": 0,
             *         "seed": 1
             *       }
             *     }
             */
            scenario: components["schemas"]["Scenario-Input"];
            /** Strategies */
            strategies: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive")[];
        };
        /**
         * Scenario
         * @description Everything a run depends on; an omitted part or field takes the paper's default.
         */
        "Scenario-Input": {
            /** @default {} */
            actuator: components["schemas"]["Actuator"];
            /**
             * @default {
             *       "friction_coefficient": 0.38,
             *       "effective_radius": 0.13,
             *       "piston_area": 0.0025,
             *       "brakes": 2,
             *       "threshold_speed": 0.1,
             *       "pressure_lag": 0.1,
             *       "wheel_radius": 0.3,
             *       "maximum_deceleration": 4,
             *       "rolling_resistance": 0.012,
             *       "drag_area": 0.65
             *     }
             */
            brake: components["schemas"]["Brake"];
            /**
             * State estimation
             * @default {
             *       "kind": "exact",
             *       "acceleration_noise": 0.05,
             *       "deflection_noise": 0.0005,
             *       "pitch_rate_noise": 0.002
             *     }
             */
            estimation: components["schemas"]["Estimation"];
            /**
             * Hardware in the loop
             * @default {
             *       "bits": 12,
             *       "compensation": "predict",
             *       "iterations": 30,
             *       "noise": 0,
             *       "jitter": 0,
             *       "packet_loss": 0,
             *       "seed": 1
             *     }
             */
            hil: components["schemas"]["Hil"];
            /**
             * Skyhook and groundhook
             * @default {
             *       "skyhook_damping": 4000,
             *       "groundhook_damping": 2000,
             *       "alpha": 0.5,
             *       "semi_active": false
             *     }
             */
            hook: components["schemas"]["Hook"];
            /**
             * LQR
             * @default {
             *       "weights": [
             *         1,
             *         1,
             *         1
             *       ],
             *       "deflection_weight": 3,
             *       "preview": "none",
             *       "preview_horizon": 30
             *     }
             */
            lqr: components["schemas"]["Lqr"];
            /**
             * Model mismatch
             * @default {
             *       "body_mass": 1,
             *       "springs": 1,
             *       "damping": 1,
             *       "tyres": 1,
             *       "rebound_ratio": 1,
             *       "preview_offset": 0,
             *       "preview_gain": 1,
             *       "preview_noise": 0,
             *       "preview_resolution": 0,
             *       "preview_delay": 0
             *     }
             */
            mismatch: components["schemas"]["Mismatch"];
            /**
             * MPC
             * @default {
             *       "sample_time": 0.01,
             *       "prediction_horizon": 30,
             *       "control_horizon": 20,
             *       "preview": "lookahead",
             *       "expected_offset": 0,
             *       "expected_noise": 0,
             *       "deflection_limit": 0.08,
             *       "force_limit": 5000,
             *       "deflection_weight": 3,
             *       "force_weight": 1e-9,
             *       "force_change_weight": 1e-10,
             *       "solver": "daqp",
             *       "stage_weights": {
             *         "brake": [
             *           2,
             *           6,
             *           1
             *         ],
             *         "bump": [
             *           1,
             *           1,
             *           6
             *         ],
             *         "cruise": [
             *           8,
             *           1,
             *           1
             *         ]
             *       },
             *       "road_weights": {
             *         "bump": [
             *           3,
             *           1,
             *           6
             *         ],
             *         "rough": [
             *           8,
             *           1,
             *           1
             *         ]
             *       }
             *     }
             */
            mpc: components["schemas"]["Mpc"];
            /**
             * @default {
             *       "roughness": 0.000064,
             *       "seed": 1,
             *       "length": 150,
             *       "bump": {
             *         "count": 1,
             *         "height": 0.1,
             *         "shape": "cosine",
             *         "spacing": 10,
             *         "start": 100,
             *         "width": 4
             *       }
             *     }
             */
            road: components["schemas"]["Road-Input"];
            /**
             * @default {
             *       "initial_speed_kmh": 50,
             *       "target_speed_kmh": 22.5,
             *       "detection_distance": 80,
             *       "controller": "guarded",
             *       "policy": "by_strategy"
             *     }
             */
            speed: components["schemas"]["Speed"];
            /**
             * @default {
             *       "body_mass": 1270,
             *       "pitch_inertia": 1536.7,
             *       "front_wheel_mass": 66.3,
             *       "rear_wheel_mass": 66.3,
             *       "cg_to_front": 1.015,
             *       "cg_to_rear": 1.895,
             *       "cg_height": 0.54,
             *       "front_spring": 27000,
             *       "rear_spring": 30000,
             *       "front_damping": 6000,
             *       "rear_damping": 6000,
             *       "front_tyre_stiffness": 268000,
             *       "rear_tyre_stiffness": 268000,
             *       "rebound_ratio": 1,
             *       "bump_stop_stiffness": 200000,
             *       "tyre_lift_off": false,
             *       "anti_dive": 0,
             *       "anti_lift": 0,
             *       "front_brake_share": 0.7
             *     }
             */
            vehicle: components["schemas"]["Vehicle"];
        };
        /**
         * Scenario
         * @description Everything a run depends on; an omitted part or field takes the paper's default.
         */
        "Scenario-Output": {
            /** @default {} */
            actuator: components["schemas"]["Actuator"];
            /**
             * @default {
             *       "friction_coefficient": 0.38,
             *       "effective_radius": 0.13,
             *       "piston_area": 0.0025,
             *       "brakes": 2,
             *       "threshold_speed": 0.1,
             *       "pressure_lag": 0.1,
             *       "wheel_radius": 0.3,
             *       "maximum_deceleration": 4,
             *       "rolling_resistance": 0.012,
             *       "drag_area": 0.65
             *     }
             */
            brake: components["schemas"]["Brake"];
            /**
             * State estimation
             * @default {
             *       "kind": "exact",
             *       "acceleration_noise": 0.05,
             *       "deflection_noise": 0.0005,
             *       "pitch_rate_noise": 0.002
             *     }
             */
            estimation: components["schemas"]["Estimation"];
            /**
             * Hardware in the loop
             * @default {
             *       "bits": 12,
             *       "compensation": "predict",
             *       "iterations": 30,
             *       "noise": 0,
             *       "jitter": 0,
             *       "packet_loss": 0,
             *       "seed": 1
             *     }
             */
            hil: components["schemas"]["Hil"];
            /**
             * Skyhook and groundhook
             * @default {
             *       "skyhook_damping": 4000,
             *       "groundhook_damping": 2000,
             *       "alpha": 0.5,
             *       "semi_active": false
             *     }
             */
            hook: components["schemas"]["Hook"];
            /**
             * LQR
             * @default {
             *       "weights": [
             *         1,
             *         1,
             *         1
             *       ],
             *       "deflection_weight": 3,
             *       "preview": "none",
             *       "preview_horizon": 30
             *     }
             */
            lqr: components["schemas"]["Lqr"];
            /**
             * Model mismatch
             * @default {
             *       "body_mass": 1,
             *       "springs": 1,
             *       "damping": 1,
             *       "tyres": 1,
             *       "rebound_ratio": 1,
             *       "preview_offset": 0,
             *       "preview_gain": 1,
             *       "preview_noise": 0,
             *       "preview_resolution": 0,
             *       "preview_delay": 0
             *     }
             */
            mismatch: components["schemas"]["Mismatch"];
            /**
             * MPC
             * @default {
             *       "sample_time": 0.01,
             *       "prediction_horizon": 30,
             *       "control_horizon": 20,
             *       "preview": "lookahead",
             *       "expected_offset": 0,
             *       "expected_noise": 0,
             *       "deflection_limit": 0.08,
             *       "force_limit": 5000,
             *       "deflection_weight": 3,
             *       "force_weight": 1e-9,
             *       "force_change_weight": 1e-10,
             *       "solver": "daqp",
             *       "stage_weights": {
             *         "brake": [
             *           2,
             *           6,
             *           1
             *         ],
             *         "bump": [
             *           1,
             *           1,
             *           6
             *         ],
             *         "cruise": [
             *           8,
             *           1,
             *           1
             *         ]
             *       },
             *       "road_weights": {
             *         "bump": [
             *           3,
             *           1,
             *           6
             *         ],
             *         "rough": [
             *           8,
             *           1,
             *           1
             *         ]
             *       }
             *     }
             */
            mpc: components["schemas"]["Mpc"];
            /**
             * @default {
             *       "roughness": 0.000064,
             *       "seed": 1,
             *       "length": 150,
             *       "bump": {
             *         "count": 1,
             *         "height": 0.1,
             *         "shape": "cosine",
             *         "spacing": 10,
             *         "start": 100,
             *         "width": 4
             *       }
             *     }
             */
            road: components["schemas"]["Road-Output"];
            /**
             * @default {
             *       "initial_speed_kmh": 50,
             *       "target_speed_kmh": 22.5,
             *       "detection_distance": 80,
             *       "controller": "guarded",
             *       "policy": "by_strategy"
             *     }
             */
            speed: components["schemas"]["Speed"];
            /**
             * @default {
             *       "body_mass": 1270,
             *       "pitch_inertia": 1536.7,
             *       "front_wheel_mass": 66.3,
             *       "rear_wheel_mass": 66.3,
             *       "cg_to_front": 1.015,
             *       "cg_to_rear": 1.895,
             *       "cg_height": 0.54,
             *       "front_spring": 27000,
             *       "rear_spring": 30000,
             *       "front_damping": 6000,
             *       "rear_damping": 6000,
             *       "front_tyre_stiffness": 268000,
             *       "rear_tyre_stiffness": 268000,
             *       "rebound_ratio": 1,
             *       "bump_stop_stiffness": 200000,
             *       "tyre_lift_off": false,
             *       "anti_dive": 0,
             *       "anti_lift": 0,
             *       "front_brake_share": 0.7
             *     }
             */
            vehicle: components["schemas"]["Vehicle"];
        };
        /**
         * Sensitivity
         * @description How a value follows one swept field.
         */
        Sensitivity: {
            /**
             * Effect
             * @description Share of the ranks' variance this field alone explains, whatever the shape: Kruskal-Wallis' H over up to ten groups of its values, (H - k + 1)/(n - k)
             */
            effect: number;
            /** Field */
            field: string;
            /**
             * P Value
             * @description Probability of as much without any effect: the smaller of both tests', doubled (Bonferroni)
             */
            p_value: number;
            /**
             * Spearman
             * @description Rank correlation: direction and strength of a monotone effect
             */
            spearman: number;
        };
        /**
         * Series
         * @description Time histories of one strategy.
         */
        Series: {
            /** Core Version */
            core_version: string;
            /**
             * Series
             * @description Lists, or typed arrays with encoding=base64
             */
            series: {
                [key: string]: (number | null)[] | components["schemas"]["TypedArray"];
            };
            /**
             * Strategy
             * @enum {string}
             */
            strategy: "lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive";
            /** Units */
            units: {
                [key: string]: string;
            };
        };
        /**
         * SeriesOfSeveral
         * @description Time histories of several strategies.
         */
        SeriesOfSeveral: {
            /** Core Version */
            core_version: string;
            /** Strategies */
            strategies: {
                [key: string]: {
                    [key: string]: (number | null)[] | components["schemas"]["TypedArray"];
                };
            };
            /** Units */
            units: {
                [key: string]: string;
            };
        };
        /**
         * Share
         * @description Shares of LV's whole change in one figure [%], which add up to 100, and that change [%].
         */
        Share: {
            /** Preview */
            preview: number;
            /** Signal */
            signal: string;
            /** Speed */
            speed: number;
            /** Statistic */
            statistic: string;
            /** Switching */
            switching: number;
            /** Total Change */
            total_change: number;
            /** Window */
            window: string;
        };
        /**
         * Solution
         * @description The largest value that keeps the limit.
         */
        Solution: {
            /**
             * Bracket
             * @description The value, and the next larger one tried, which does not keep the limit; twice the value at the top of the range
             */
            bracket: [
                number,
                number
            ];
            /** Core Version */
            core_version: string;
            /** @description The metric at that value over the roads; null for one road */
            interval: components["schemas"]["Interval"] | null;
            /**
             * Metric Unit
             * @description 1 for none
             */
            metric_unit: string;
            /**
             * Metric Value
             * @description What is held to the limit; over several roads the interval's upper end
             */
            metric_value: number;
            /**
             * Run Id
             * @description The run at that value
             */
            run_id: string;
            /**
             * Runs
             * @description How many runs it took, one a road and value tried; equal ones are stored once
             */
            runs: number;
            /**
             * Tried
             * @description Every value tried, in order
             */
            tried: components["schemas"]["TriedValue"][];
            /**
             * Unit
             * @description Of the field; 1 for none
             */
            unit: string;
            /**
             * Value
             * @description The field's unit
             */
            value: number;
            /**
             * Warnings
             * @description Where the metric is not monotone, and what else the value does not tell
             */
            warnings: string[];
        };
        /**
         * SolveRequest
         * @description How large a field may be: the largest value in a range that keeps a metric at or below a limit.
         * @example {
         *       "scenario": {
         *         "road": {
         *           "length": 130,
         *           "bump": {
         *             "height": 0.08
         *           }
         *         },
         *         "speed": {
         *           "target_speed_kmh": 25
         *         }
         *       },
         *       "strategy": "passive",
         *       "field": "road.bump.height",
         *       "range": [
         *         0.01,
         *         0.2
         *       ],
         *       "metric": "bump.body_acceleration.peak",
         *       "limit": 4
         *     }
         */
        SolveRequest: {
            /**
             * Field
             * @description By its dotted name; one that takes a number
             * @enum {string}
             */
            field: "vehicle.body_mass" | "vehicle.pitch_inertia" | "vehicle.front_wheel_mass" | "vehicle.rear_wheel_mass" | "vehicle.cg_to_front" | "vehicle.cg_to_rear" | "vehicle.cg_height" | "vehicle.front_spring" | "vehicle.rear_spring" | "vehicle.front_damping" | "vehicle.rear_damping" | "vehicle.front_tyre_stiffness" | "vehicle.rear_tyre_stiffness" | "vehicle.rebound_ratio" | "vehicle.bump_stop_clearance" | "vehicle.bump_stop_stiffness" | "vehicle.anti_dive" | "vehicle.anti_lift" | "vehicle.front_brake_share" | "road.roughness" | "road.length" | "road.bump.height" | "road.bump.width" | "road.bump.start" | "road.bump.count" | "road.bump.spacing" | "speed.initial_speed_kmh" | "speed.target_speed_kmh" | "speed.detection_distance" | "brake.friction_coefficient" | "brake.effective_radius" | "brake.piston_area" | "brake.brakes" | "brake.threshold_speed" | "brake.pressure_lag" | "brake.wheel_radius" | "brake.maximum_deceleration" | "brake.rolling_resistance" | "brake.drag_area" | "actuator.bandwidth" | "actuator.rate_limit" | "actuator.saturation" | "mismatch.body_mass" | "mismatch.springs" | "mismatch.damping" | "mismatch.tyres" | "mismatch.rebound_ratio" | "mismatch.preview_offset" | "mismatch.preview_gain" | "mismatch.preview_noise" | "mismatch.preview_resolution" | "mismatch.preview_delay" | "estimation.acceleration_noise" | "estimation.deflection_noise" | "estimation.pitch_rate_noise" | "mpc.sample_time" | "mpc.prediction_horizon" | "mpc.control_horizon" | "mpc.expected_offset" | "mpc.expected_noise" | "mpc.deflection_limit" | "mpc.force_limit" | "mpc.deflection_weight" | "mpc.force_weight" | "mpc.force_change_weight" | "mpc.stage_weights.cruise.0" | "mpc.stage_weights.cruise.1" | "mpc.stage_weights.cruise.2" | "mpc.stage_weights.brake.0" | "mpc.stage_weights.brake.1" | "mpc.stage_weights.brake.2" | "mpc.stage_weights.bump.0" | "mpc.stage_weights.bump.1" | "mpc.stage_weights.bump.2" | "mpc.road_weights.rough.0" | "mpc.road_weights.rough.1" | "mpc.road_weights.rough.2" | "mpc.road_weights.bump.0" | "mpc.road_weights.bump.1" | "mpc.road_weights.bump.2" | "lqr.weights.0" | "lqr.weights.1" | "lqr.weights.2" | "lqr.deflection_weight" | "lqr.preview_horizon" | "hook.skyhook_damping" | "hook.groundhook_damping" | "hook.alpha" | "hil.bits" | "hil.iterations" | "hil.noise" | "hil.jitter" | "hil.packet_loss";
            /**
             * Limit
             * @description The metric's unit; over several roads its interval keeps it
             */
            limit: number;
            /**
             * Metric
             * @description By its flat name, a column of a batch's table
             * @enum {string}
             */
            metric: "rough_road.body_acceleration.rms" | "rough_road.body_acceleration.peak" | "rough_road.pitch_acceleration.rms" | "rough_road.pitch_acceleration.peak" | "rough_road.front_tyre_load.rms" | "rough_road.front_tyre_load.peak" | "rough_road.rear_tyre_load.rms" | "rough_road.rear_tyre_load.peak" | "rough_road.front_deflection.rms" | "rough_road.front_deflection.peak" | "rough_road.rear_deflection.rms" | "rough_road.rear_deflection.peak" | "rough_road.front_force.rms" | "rough_road.front_force.peak" | "rough_road.rear_force.rms" | "rough_road.rear_force.peak" | "bump.body_acceleration.rms" | "bump.body_acceleration.peak" | "bump.pitch_acceleration.rms" | "bump.pitch_acceleration.peak" | "bump.front_tyre_load.rms" | "bump.front_tyre_load.peak" | "bump.rear_tyre_load.rms" | "bump.rear_tyre_load.peak" | "bump.front_deflection.rms" | "bump.front_deflection.peak" | "bump.rear_deflection.rms" | "bump.rear_deflection.peak" | "bump.front_force.rms" | "bump.front_force.peak" | "bump.rear_force.rms" | "bump.rear_force.peak" | "whole.body_acceleration.rms" | "whole.body_acceleration.peak" | "whole.pitch_acceleration.rms" | "whole.pitch_acceleration.peak" | "whole.front_tyre_load.rms" | "whole.front_tyre_load.peak" | "whole.rear_tyre_load.rms" | "whole.rear_tyre_load.peak" | "whole.front_deflection.rms" | "whole.front_deflection.peak" | "whole.rear_deflection.rms" | "whole.rear_deflection.peak" | "whole.front_force.rms" | "whole.front_force.peak" | "whole.rear_force.rms" | "whole.rear_force.peak" | "comfort.weighted_rms" | "comfort.vibration_dose" | "comfort.front_dynamic_load_coefficient" | "comfort.rear_dynamic_load_coefficient" | "comfort.actuator_mean_power" | "comfort.actuator_peak_power" | "events.airborne_ms" | "events.front_airborne_ms" | "events.rear_airborne_ms" | "events.travel_exceeded_mm" | "events.limited_steps" | "events.qp_solves" | "events.qp_fallbacks" | "events.qp_failures" | "events.max_slack_mm" | "events.ecu_most_iterations" | "events.ecu_clipped_values" | "events.ecu_held_commands" | "travel_time" | "arrival_speed_kmh";
            /**
             * Range
             * @description [lowest, highest], its unit
             */
            range: [
                number,
                number
            ];
            /**
             * Roads
             * @description Seeds road.seed, road.seed + 1, …; each strategy drives all
             * @default 1
             */
            roads: number;
            /**
             * @default {
             *       "vehicle": {
             *         "anti_dive": 0,
             *         "anti_lift": 0,
             *         "body_mass": 1270,
             *         "bump_stop_stiffness": 200000,
             *         "cg_height": 0.54,
             *         "cg_to_front": 1.015,
             *         "cg_to_rear": 1.895,
             *         "front_brake_share": 0.7,
             *         "front_damping": 6000,
             *         "front_spring": 27000,
             *         "front_tyre_stiffness": 268000,
             *         "front_wheel_mass": 66.3,
             *         "pitch_inertia": 1536.7,
             *         "rear_damping": 6000,
             *         "rear_spring": 30000,
             *         "rear_tyre_stiffness": 268000,
             *         "rear_wheel_mass": 66.3,
             *         "rebound_ratio": 1,
             *         "tyre_lift_off": false
             *       },
             *       "road": {
             *         "bump": {
             *           "count": 1,
             *           "height": 0.1,
             *           "shape": "cosine",
             *           "spacing": 10,
             *           "start": 100,
             *           "width": 4
             *         },
             *         "length": 150,
             *         "roughness": 0.000064,
             *         "seed": 1
             *       },
             *       "speed": {
             *         "controller": "guarded",
             *         "detection_distance": 80,
             *         "initial_speed_kmh": 50,
             *         "policy": "by_strategy",
             *         "target_speed_kmh": 22.5
             *       },
             *       "brake": {
             *         "brakes": 2,
             *         "drag_area": 0.65,
             *         "effective_radius": 0.13,
             *         "friction_coefficient": 0.38,
             *         "maximum_deceleration": 4,
             *         "piston_area": 0.0025,
             *         "pressure_lag": 0.1,
             *         "rolling_resistance": 0.012,
             *         "threshold_speed": 0.1,
             *         "wheel_radius": 0.3
             *       },
             *       "actuator": {},
             *       "mismatch": {
             *         "body_mass": 1,
             *         "damping": 1,
             *         "preview_delay": 0,
             *         "preview_gain": 1,
             *         "preview_noise": 0,
             *         "preview_offset": 0,
             *         "preview_resolution": 0,
             *         "rebound_ratio": 1,
             *         "springs": 1,
             *         "tyres": 1
             *       },
             *       "estimation": {
             *         "acceleration_noise": 0.05,
             *         "deflection_noise": 0.0005,
             *         "kind": "exact",
             *         "pitch_rate_noise": 0.002
             *       },
             *       "mpc": {
             *         "control_horizon": 20,
             *         "deflection_limit": 0.08,
             *         "deflection_weight": 3,
             *         "expected_noise": 0,
             *         "expected_offset": 0,
             *         "force_change_weight": 1e-10,
             *         "force_limit": 5000,
             *         "force_weight": 1e-9,
             *         "prediction_horizon": 30,
             *         "preview": "lookahead",
             *         "road_weights": {
             *           "bump": [
             *             3,
             *             1,
             *             6
             *           ],
             *           "rough": [
             *             8,
             *             1,
             *             1
             *           ]
             *         },
             *         "sample_time": 0.01,
             *         "solver": "daqp",
             *         "stage_weights": {
             *           "brake": [
             *             2,
             *             6,
             *             1
             *           ],
             *           "bump": [
             *             1,
             *             1,
             *             6
             *           ],
             *           "cruise": [
             *             8,
             *             1,
             *             1
             *           ]
             *         }
             *       },
             *       "lqr": {
             *         "deflection_weight": 3,
             *         "preview": "none",
             *         "preview_horizon": 30,
             *         "weights": [
             *           1,
             *           1,
             *           1
             *         ]
             *       },
             *       "hook": {
             *         "alpha": 0.5,
             *         "groundhook_damping": 2000,
             *         "semi_active": false,
             *         "skyhook_damping": 4000
             *       },
             *       "hil": {
             *         "bits": 12,
             *         "compensation": "predict",
             *         "iterations": 30,
             *         "jitter": 0,
             *         "noise": 0,
             *         "packet_loss": 0,
             *         "seed": 1
             *       }
             *     }
             */
            scenario: components["schemas"]["Scenario-Input"];
            /**
             * Strategy
             * @enum {string}
             */
            strategy: "lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive";
        };
        /**
         * Speed
         * @description Speeds and when braking begins (section 3.1).
         */
        Speed: {
            /**
             * Speed controller
             * @description fuzzy is Table 1 alone; guarded (ours) brakes at least as hard as the distance left needs, which changes nothing on the paper's scenario.
             * @default guarded
             * @enum {string}
             */
            controller: "guarded" | "fuzzy";
            /**
             * Detection distance
             * @description How far ahead the bump is seen and braking begins.
             * @default 80
             */
            detection_distance: number;
            /**
             * Initial speed
             * @description Held until the bump is detected.
             * @default 50
             */
            initial_speed_kmh: number;
            /**
             * Who slows down
             * @description by_strategy: those that have a speed control, as in the paper. At equal speed what is left of a gain is the suspension's: planned slows all of them down for the bump, constant none.
             * @default by_strategy
             * @enum {string}
             */
            policy: "by_strategy" | "planned" | "constant";
            /**
             * Target speed
             * @description Aimed at for the bump; the paper's 20 to 25 km/h.
             * @default 22.5
             */
            target_speed_kmh: number;
        };
        /**
         * StabilitySummary
         * @description Least damping ratio of the closed loop's modes near rest [1]; below 0 the loop is unstable.
         */
        StabilitySummary: {
            highest: components["schemas"]["Place"] | null;
            /**
             * Known
             * @description Runs whose loop could be judged
             */
            known: number;
            lowest: components["schemas"]["Place"] | null;
            /** Mean */
            mean: number | null;
            /** N */
            n: number;
            /** Nominal */
            nominal: number | null;
            /**
             * Quantiles
             * @description At the percentages in the answer's `quantiles`
             */
            quantiles: number[] | null;
            /** Sensitivity */
            sensitivity: components["schemas"]["Sensitivity"][];
            /** Unstable */
            unstable: number;
        };
        /**
         * Stage
         * @description One driving stage, by the front axle.
         */
        Stage: {
            /**
             * End Position
             * @description [m]
             */
            end_position: number;
            /**
             * End Time
             * @description [s]
             */
            end_time: number;
            /**
             * Stage
             * @enum {string}
             */
            stage: "cruise" | "brake" | "bump";
            /**
             * Start Position
             * @description [m]
             */
            start_position: number;
            /**
             * Start Time
             * @description [s]
             */
            start_time: number;
        };
        /**
         * StageWeights
         * @description LV control's weights per driving stage (Table 6).
         */
        StageWeights: {
            /**
             * Brake
             * @description Braking: pitch first.
             * @default [
             *       2,
             *       6,
             *       1
             *     ]
             */
            brake: [
                number,
                number,
                number
            ];
            /**
             * Bump
             * @description On the bump: tyre load first.
             * @default [
             *       1,
             *       1,
             *       6
             *     ]
             */
            bump: [
                number,
                number,
                number
            ];
            /**
             * Cruise
             * @description Uniform speed: comfort first.
             * @default [
             *       8,
             *       1,
             *       1
             *     ]
             */
            cruise: [
                number,
                number,
                number
            ];
        };
        /**
         * Statistics
         * @description One signal in one window.
         */
        Statistics: {
            /** Peak */
            peak: number;
            /** Rms */
            rms: number;
        };
        /**
         * StepTime
         * @description About how long one step takes on the part [s].
         */
        StepTime: {
            /** Least */
            least: number;
            /** Most */
            most: number;
        };
        /**
         * StrategyAnswer
         * @description A strategy: what it does, which parts of the scenario it reads, how it is drawn.
         */
        StrategyAnswer: {
            /** Colour */
            colour: string;
            /**
             * Dark Colour
             * @description On a dark background
             */
            dark_colour: string;
            /** Dash */
            dash: string;
            /** Description */
            description: string;
            /** Id */
            id: string;
            /** Label */
            label: string;
            /**
             * One Road Resolution
             * @description Smaller changes [%] on one road may be luck; by statistic, comfort figures as an RMS. Of two strategies the larger one counts
             */
            one_road_resolution: {
                [key: string]: number;
            };
            /** Reads */
            reads: string[];
        };
        /**
         * StrategyChanges
         * @description One strategy's paired changes over several roads, by window (catalogue: windows), and of its comfort.
         */
        StrategyChanges: {
            /**
             * Bump
             * @description By signal (catalogue: metric_signals), in %
             */
            bump: {
                [key: string]: components["schemas"]["Changes"];
            };
            /**
             * Comfort
             * @description Catalogue: comfort; in %
             */
            comfort: {
                [key: string]: components["schemas"]["Interval"] | null;
            };
            /**
             * Rough Road
             * @description By signal (catalogue: metric_signals), in %
             */
            rough_road: {
                [key: string]: components["schemas"]["Changes"];
            };
            /**
             * Whole
             * @description By signal (catalogue: metric_signals), in %
             */
            whole: {
                [key: string]: components["schemas"]["Changes"];
            };
        };
        /**
         * StrategyFailure
         * @description A strategy the core refuses for this scenario, and why.
         */
        StrategyFailure: {
            /** Compute Ms */
            compute_ms: number;
            /**
             * Fields
             * @description Dotted names of scenario fields that make it cheaper
             * @default []
             */
            fields: string[];
            /**
             * Kind
             * @description `too-expensive` where the run would take more computing than one may: change one of `fields`
             * @default refused
             * @enum {string}
             */
            kind: "refused" | "too-expensive";
            /** Reason */
            reason: string;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            status: "failed";
        };
        /**
         * StrategyResult
         * @description One strategy's figures over the scenario.
         */
        StrategyResult: {
            /**
             * Arrival Speed Kmh
             * @description [km/h]; the same on every road
             */
            arrival_speed_kmh: number;
            /**
             * Comfort
             * @description Catalogue: comfort
             */
            comfort: {
                [key: string]: number;
            };
            /**
             * Compute Ms
             * @description The worker's own time [ms]; work shared between strategies counts once
             */
            compute_ms: number;
            /**
             * Events
             * @description Catalogue: events
             */
            events: {
                [key: string]: boolean | number | null;
            };
            /**
             * Metrics
             * @description By window (catalogue: windows)
             */
            metrics: {
                [key: string]: {
                    [key: string]: components["schemas"]["Statistics"];
                };
            };
            /**
             * Reference
             * @description Lines a plot draws; catalogue: references
             */
            reference: {
                [key: string]: number | null;
            };
            /** Stages */
            stages: components["schemas"]["Stage"][];
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            status: "ok";
            /**
             * Travel Time
             * @description [s]; the same on every road
             */
            travel_time: number;
        };
        /**
         * StrategySummary
         * @description One strategy over all points.
         */
        StrategySummary: {
            /** Failed */
            failed: number;
            /** Figures */
            figures: {
                [key: string]: components["schemas"]["FigureSummary"];
            };
            /** Ok */
            ok: number;
            /**
             * Reasons
             * @description The commonest why runs failed
             */
            reasons: {
                [key: string]: number;
            };
            stability: components["schemas"]["StabilitySummary"];
            /**
             * Unfinished
             * @description Waiting or cancelled
             */
            unfinished: number;
        };
        /**
         * Sweep
         * @description Exactly one of its three forms; `linked` with any of them.
         */
        Sweep: {
            /**
             * Grid
             * @description Field -> values; every combination, the last field changing fastest
             */
            grid?: {
                [key: string]: (number | string | boolean | null | number[])[];
            } | null;
            latin_hypercube?: components["schemas"]["LatinHypercube"] | null;
            /**
             * Linked
             * @description Swept field -> further fields that take its value at each point, such as one speed for both
             */
            linked?: {
                [key: string]: string[];
            } | null;
            /**
             * List
             * @description Field -> value, point by point; a field a point does not name keeps its value
             */
            list?: {
                [key: string]: number | string | boolean | null | number[];
            }[] | null;
        };
        /**
         * TableAnswer
         * @description One table of the paper.
         */
        TableAnswer: {
            /** Columns */
            columns: components["schemas"]["Column"][];
            /** Number */
            number: number;
            /** Title */
            title: string;
        };
        /**
         * Times
         * @description Times [s] with a histogram: `counts[i]` lie between `edges[i]` and `edges[i + 1]`; those outside at the ends.
         */
        Times: {
            /** Counts */
            counts: number[];
            /** Deviation */
            deviation: number;
            /** Edges */
            edges: number[];
            /** Mean */
            mean: number;
            /** Median */
            median: number;
            /** Most */
            most: number;
            /** Percentile 99 */
            percentile_99: number;
        };
        /**
         * Trial
         * @description A set of weights and what it gave on the training roads.
         */
        Trial: {
            /**
             * Feasible
             * @description Within every limit on every training road; failed ones are not
             */
            feasible: boolean;
            /** Generation */
            generation: number;
            /**
             * Limits
             * @description A limit each: the largest over the training roads
             */
            limits: number[] | null;
            /** Number */
            number: number;
            /**
             * Reason
             * @description Of a failed one
             */
            reason: string | null;
            /**
             * Status
             * @enum {string}
             */
            status: "ok" | "failed";
            /**
             * Values
             * @description An objective each: its mean, or quantile, over the training roads
             */
            values: number[] | null;
            /**
             * Weights
             * @description The strategy's weights, and what else was searched, by dotted name, to be put into the scenario as they are
             */
            weights: {
                [key: string]: number | string | number[];
            };
        };
        /**
         * TrialCounts
         * @description Numbers of trials.
         */
        TrialCounts: {
            /** Done */
            done: number;
            /** Failed */
            failed: number;
            /** Feasible */
            feasible: number;
            /** Total */
            total: number;
        };
        /**
         * Trials
         * @description Every trial, in order.
         */
        Trials: {
            /** Trials */
            trials: components["schemas"]["Trial"][];
            /** Tuning */
            tuning: string;
        };
        /**
         * TriedValue
         * @description One value that was tried.
         */
        TriedValue: {
            /**
             * Metric Value
             * @description What is held to the limit; null where there is none
             */
            metric_value: number | null;
            /**
             * Reason
             * @description Why there is no metric; null where there is
             */
            reason: string | null;
            /**
             * Run Id
             * @description The run at that value; null where the scenario has none
             */
            run_id: string | null;
            /** Value */
            value: number;
        };
        /**
         * TunedChange
         * @description Change of a mean against the paper's weights, paired by road, with its 95 % interval [%].
         */
        TunedChange: {
            /** High */
            high: number | null;
            /**
             * Low
             * @description Null on one road
             */
            low: number | null;
            /** Value */
            value: number;
        };
        /**
         * TunedFigures
         * @description One figure of one set of weights over some roads.
         */
        TunedFigures: {
            /** @description Null for the paper's weights themselves and against zero */
            change: components["schemas"]["TunedChange"] | null;
            /** Mean */
            mean: number;
            /**
             * Quantile
             * @description At the tuning's `quantile`; null where it has none
             */
            quantile: number | null;
            /**
             * Worst
             * @description The largest over the roads
             */
            worst: number;
        };
        /**
         * Tuning
         * @description A tuning in its present state.
         */
        Tuning: {
            /**
             * Batch
             * @description The batch it waits for, or waited for last
             */
            batch: string | null;
            /**
             * Best
             * @description An objective each: the feasible trial with its smallest value
             */
            best: (components["schemas"]["Trial"] | null)[];
            comparison: components["schemas"]["Comparison"] | null;
            /** Core Version */
            core_version: string;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /**
             * Estimated Cost
             * @description Estimate [s of one core]
             */
            estimated_cost: number;
            /** Finished At */
            finished_at: string | null;
            /** Fresh Seeds */
            fresh_seeds: number[];
            /**
             * Front
             * @description Feasible trials that no other one betters, by the first objective
             */
            front: components["schemas"]["Trial"][];
            /**
             * Generation
             * @description Generations that are complete
             */
            generation: number;
            /** History */
            history: components["schemas"]["Generation"][];
            /** Id */
            id: string;
            /** @description Of several objectives: the point of the front nearest to its ideal corner */
            knee: components["schemas"]["Trial"] | null;
            /** Label */
            label: string | null;
            /** Limits */
            limits: components["schemas"]["LimitAnswer"][];
            /** Objectives */
            objectives: components["schemas"]["ObjectiveAnswer"][];
            /** @description The scenario's own weights where they are not the paper's */
            own: components["schemas"]["Trial"] | null;
            /** @description The paper's weights; null until the first generation is complete */
            paper: components["schemas"]["Trial"] | null;
            /** Population */
            population: number;
            /**
             * Position
             * @description Runs waiting before it: 0, its batches have positions of their own
             */
            position: number;
            /**
             * Previews
             * @description Kinds of preview searched; null where only the scenario's is used
             */
            previews: string[] | null;
            /**
             * Quantile
             * @description Of the objectives over the roads; null for their means
             */
            quantile: number | null;
            /**
             * Reason
             * @description Why it failed
             */
            reason: string | null;
            /** Scenario */
            scenario: {
                [key: string]: unknown;
            };
            /** Search */
            search: {
                [key: string]: number[];
            };
            /** Seed */
            seed: number;
            /** Seeds */
            seeds: number[];
            /** Started At */
            started_at: string | null;
            /**
             * State
             * @enum {string}
             */
            state: "queued" | "running" | "done" | "cancelled" | "failed";
            /**
             * Step
             * @description What it does, or did last
             * @enum {string}
             */
            step: "search" | "comparison";
            /**
             * Strategy
             * @enum {string}
             */
            strategy: "lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive";
            trials: components["schemas"]["TrialCounts"];
            /** Uncertain */
            uncertain: boolean;
        };
        /**
         * TuningEstimate
         * @description The size and the estimated time of a tuning.
         */
        TuningEstimate: {
            /**
             * Estimated Cost
             * @description Estimate, which is compared with the limit [s of one core]
             */
            estimated_cost: number;
            /**
             * Estimated Seconds
             * @description By some runs tried just now [s]; none where trying takes long
             */
            estimated_seconds: number | null;
            /** Generations */
            generations: number;
            /**
             * Runs
             * @description Of the search and the comparison, the passive car's included
             */
            runs: number;
        };
        /**
         * TuningItem
         * @description A tuning in a list.
         */
        TuningItem: {
            /**
             * Batch
             * @description The batch it waits for, or waited for last
             */
            batch: string | null;
            /** Core Version */
            core_version: string;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /**
             * Estimated Cost
             * @description Estimate [s of one core]
             */
            estimated_cost: number;
            /** Finished At */
            finished_at: string | null;
            /** Fresh Seeds */
            fresh_seeds: number[];
            /**
             * Generation
             * @description Generations that are complete
             */
            generation: number;
            /** Id */
            id: string;
            /** Label */
            label: string | null;
            /** Limits */
            limits: components["schemas"]["LimitAnswer"][];
            /** Objectives */
            objectives: components["schemas"]["ObjectiveAnswer"][];
            /** Population */
            population: number;
            /**
             * Position
             * @description Runs waiting before it: 0, its batches have positions of their own
             */
            position: number;
            /**
             * Previews
             * @description Kinds of preview searched; null where only the scenario's is used
             */
            previews: string[] | null;
            /**
             * Quantile
             * @description Of the objectives over the roads; null for their means
             */
            quantile: number | null;
            /**
             * Reason
             * @description Why it failed
             */
            reason: string | null;
            /** Search */
            search: {
                [key: string]: number[];
            };
            /** Seed */
            seed: number;
            /** Seeds */
            seeds: number[];
            /** Started At */
            started_at: string | null;
            /**
             * State
             * @enum {string}
             */
            state: "queued" | "running" | "done" | "cancelled" | "failed";
            /**
             * Step
             * @description What it does, or did last
             * @enum {string}
             */
            step: "search" | "comparison";
            /**
             * Strategy
             * @enum {string}
             */
            strategy: "lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive";
            trials: components["schemas"]["TrialCounts"];
            /** Uncertain */
            uncertain: boolean;
        };
        /**
         * TuningRequest
         * @description What to tune, for what, on which roads and cars.
         * @example {
         *       "scenario": {
         *         "road": {
         *           "length": 130,
         *           "bump": {
         *             "height": 0.08
         *           }
         *         },
         *         "speed": {
         *           "target_speed_kmh": 25
         *         }
         *       },
         *       "strategy": "lqr",
         *       "trials": 2,
         *       "population": 2,
         *       "seeds": [
         *         1
         *       ],
         *       "fresh_seeds": [
         *         2,
         *         3
         *       ]
         *     }
         */
        TuningRequest: {
            /**
             * Dry Run
             * @description Only check and estimate: nothing is stored or computed
             * @default false
             */
            dry_run: boolean;
            /**
             * Fresh Seeds
             * @description Roads compared on, none trained on
             * @default [
             *       101,
             *       102,
             *       103,
             *       104,
             *       105,
             *       106,
             *       107,
             *       108,
             *       109,
             *       110
             *     ]
             */
            fresh_seeds: number[];
            /**
             * Label
             * @description A name for it, to find it again
             */
            label?: string | null;
            /**
             * Limits
             * @default []
             */
            limits: components["schemas"]["Limit"][];
            /**
             * Objectives
             * @default [
             *       {
             *         "kind": "paper",
             *         "q": [
             *           1,
             *           1,
             *           1
             *         ]
             *       }
             *     ]
             */
            objectives: components["schemas"]["Objective"][];
            /**
             * Population
             * @description Sets of weights tried at once: a generation
             * @default 16
             */
            population: number;
            /**
             * Previews
             * @description Kinds of preview to try; without it only the scenario's is used
             */
            previews?: ("none" | "wheelbase" | "lookahead" | "obstacle")[] | null;
            /**
             * Quantile
             * @description Minimise this quantile over the training roads, 1 the worst, not the mean
             */
            quantile?: number | null;
            /**
             * @default {
             *       "vehicle": {
             *         "anti_dive": 0,
             *         "anti_lift": 0,
             *         "body_mass": 1270,
             *         "bump_stop_stiffness": 200000,
             *         "cg_height": 0.54,
             *         "cg_to_front": 1.015,
             *         "cg_to_rear": 1.895,
             *         "front_brake_share": 0.7,
             *         "front_damping": 6000,
             *         "front_spring": 27000,
             *         "front_tyre_stiffness": 268000,
             *         "front_wheel_mass": 66.3,
             *         "pitch_inertia": 1536.7,
             *         "rear_damping": 6000,
             *         "rear_spring": 30000,
             *         "rear_tyre_stiffness": 268000,
             *         "rear_wheel_mass": 66.3,
             *         "rebound_ratio": 1,
             *         "tyre_lift_off": false
             *       },
             *       "road": {
             *         "bump": {
             *           "count": 1,
             *           "height": 0.1,
             *           "shape": "cosine",
             *           "spacing": 10,
             *           "start": 100,
             *           "width": 4
             *         },
             *         "length": 150,
             *         "roughness": 0.000064,
             *         "seed": 1
             *       },
             *       "speed": {
             *         "controller": "guarded",
             *         "detection_distance": 80,
             *         "initial_speed_kmh": 50,
             *         "policy": "by_strategy",
             *         "target_speed_kmh": 22.5
             *       },
             *       "brake": {
             *         "brakes": 2,
             *         "drag_area": 0.65,
             *         "effective_radius": 0.13,
             *         "friction_coefficient": 0.38,
             *         "maximum_deceleration": 4,
             *         "piston_area": 0.0025,
             *         "pressure_lag": 0.1,
             *         "rolling_resistance": 0.012,
             *         "threshold_speed": 0.1,
             *         "wheel_radius": 0.3
             *       },
             *       "actuator": {},
             *       "mismatch": {
             *         "body_mass": 1,
             *         "damping": 1,
             *         "preview_delay": 0,
             *         "preview_gain": 1,
             *         "preview_noise": 0,
             *         "preview_offset": 0,
             *         "preview_resolution": 0,
             *         "rebound_ratio": 1,
             *         "springs": 1,
             *         "tyres": 1
             *       },
             *       "estimation": {
             *         "acceleration_noise": 0.05,
             *         "deflection_noise": 0.0005,
             *         "kind": "exact",
             *         "pitch_rate_noise": 0.002
             *       },
             *       "mpc": {
             *         "control_horizon": 20,
             *         "deflection_limit": 0.08,
             *         "deflection_weight": 3,
             *         "expected_noise": 0,
             *         "expected_offset": 0,
             *         "force_change_weight": 1e-10,
             *         "force_limit": 5000,
             *         "force_weight": 1e-9,
             *         "prediction_horizon": 30,
             *         "preview": "lookahead",
             *         "road_weights": {
             *           "bump": [
             *             3,
             *             1,
             *             6
             *           ],
             *           "rough": [
             *             8,
             *             1,
             *             1
             *           ]
             *         },
             *         "sample_time": 0.01,
             *         "solver": "daqp",
             *         "stage_weights": {
             *           "brake": [
             *             2,
             *             6,
             *             1
             *           ],
             *           "bump": [
             *             1,
             *             1,
             *             6
             *           ],
             *           "cruise": [
             *             8,
             *             1,
             *             1
             *           ]
             *         }
             *       },
             *       "lqr": {
             *         "deflection_weight": 3,
             *         "preview": "none",
             *         "preview_horizon": 30,
             *         "weights": [
             *           1,
             *           1,
             *           1
             *         ]
             *       },
             *       "hook": {
             *         "alpha": 0.5,
             *         "groundhook_damping": 2000,
             *         "semi_active": false,
             *         "skyhook_damping": 4000
             *       },
             *       "hil": {
             *         "bits": 12,
             *         "compensation": "predict",
             *         "iterations": 30,
             *         "jitter": 0,
             *         "noise": 0,
             *         "packet_loss": 0,
             *         "seed": 1
             *       }
             *     }
             */
            scenario: components["schemas"]["Scenario-Input"];
            /**
             * Search
             * @description Weight, horizon, sample time or what is expected of the preview -> [lowest, highest], searched on a logarithmic scale, a horizon step by step; what is not named keeps the scenario's value. Without it every weight of the strategy, 0.05 to 50.
             */
            search?: {
                [key: string]: [
                    number,
                    number
                ];
            } | null;
            /**
             * Seed
             * @description Of the search: same request, same trials
             * @default 0
             */
            seed: number;
            /**
             * Seeds
             * @description Roads trained on
             * @default [
             *       1,
             *       2,
             *       3,
             *       4
             *     ]
             */
            seeds: number[];
            /**
             * Strategy
             * @default lv
             * @enum {string}
             */
            strategy: "lv" | "suspension_only" | "lqr";
            /**
             * Trials
             * @description Sets of weights, the paper's and the scenario's included
             * @default 200
             */
            trials: number;
            /**
             * Uncertain
             * @description Every road also draws, by its seed, what a robustness study varies by default: the car, its sensors and actuators, none of which the controllers know
             * @default false
             */
            uncertain: boolean;
        };
        /**
         * Tunings
         * @description A page of tunings, the newest first.
         */
        Tunings: {
            /**
             * Next
             * @description Cursor of the next page; null on the last one
             */
            next: string | null;
            /** Tunings */
            tunings: components["schemas"]["TuningItem"][];
        };
        /**
         * TypedArray
         * @description Little-endian float32 in base64: plotly's typed-array form.
         */
        TypedArray: {
            /** Bdata */
            bdata: string;
            /**
             * Dtype
             * @constant
             */
            dtype: "f4";
        };
        /**
         * Unavailable
         * @description Hardware in the loop cannot be driven here: its cells have no verdict and no part in any count.
         */
        Unavailable: {
            /** Cells */
            cells: number;
            /**
             * Reason
             * @description What is missing, and what brings it
             */
            reason: string;
        };
        /**
         * UncertainRange
         * @description An uncertain field and the range that a study samples.
         */
        UncertainRange: {
            /** Field */
            field: string;
            /** High */
            high: number;
            /** Low */
            low: number;
            /** Title */
            title: string;
            /** Unit */
            unit: string;
            /** Why */
            why: string;
        };
        /**
         * Vehicle
         * @description Half-car model: body with heave and pitch, front and rear wheel (Table 2).
         */
        Vehicle: {
            /**
             * Anti-dive
             * @description Share of the load transfer that the front links would carry if only the front wheels braked: tan β L / h.
             * @default 0
             */
            anti_dive: number;
            /**
             * Anti-lift
             * @description Share of the load transfer that the rear links would carry if only the rear wheels braked: tan β L / h.
             * @default 0
             */
            anti_lift: number;
            /**
             * Body mass
             * @description Sprung mass m_b.
             * @default 1270
             */
            body_mass: number;
            /**
             * Clearance of the stops
             * @description Travel either way from rest until a stop is met; none is a car without stops.
             */
            bump_stop_clearance?: number | null;
            /**
             * Stiffness of the stops
             * @description Added to the spring's beyond the clearance (ours).
             * @default 200000
             */
            bump_stop_stiffness: number;
            /**
             * Height of the centre of gravity
             * @description Arm of the braking force on the body h_cg (ours).
             * @default 0.54
             */
            cg_height: number;
            /**
             * Centre of gravity to front axle
             * @description Distance a.
             * @default 1.015
             */
            cg_to_front: number;
            /**
             * Centre of gravity to rear axle
             * @description Distance b.
             * @default 1.895
             */
            cg_to_rear: number;
            /**
             * Front brakes' share
             * @description Of the braking force (ours); for anti-dive.
             * @default 0.7
             */
            front_brake_share: number;
            /**
             * Front damper
             * @description Damping C_s1.
             * @default 6000
             */
            front_damping: number;
            /**
             * Front spring
             * @description Suspension stiffness k_s1.
             * @default 27000
             */
            front_spring: number;
            /**
             * Front tyre stiffness
             * @description Vertical stiffness k_u1.
             * @default 268000
             */
            front_tyre_stiffness: number;
            /**
             * Front wheel mass
             * @description Unsprung mass m_w1.
             * @default 66.3
             */
            front_wheel_mass: number;
            /**
             * Pitch inertia
             * @description Body inertia about the pitch axis I_yy.
             * @default 1536.7
             */
            pitch_inertia: number;
            /**
             * Rear damper
             * @description Damping C_s2.
             * @default 6000
             */
            rear_damping: number;
            /**
             * Rear spring
             * @description Suspension stiffness k_s2.
             * @default 30000
             */
            rear_spring: number;
            /**
             * Rear tyre stiffness
             * @description Vertical stiffness k_u2.
             * @default 268000
             */
            rear_tyre_stiffness: number;
            /**
             * Rear wheel mass
             * @description Unsprung mass m_w2.
             * @default 66.3
             */
            rear_wheel_mass: number;
            /**
             * Rebound over compression
             * @description Of both dampers, at the same mean damping; real ones have 2 to 3. The controllers know the mean alone.
             * @default 1
             */
            rebound_ratio: number;
            /**
             * Tyres lift off
             * @description On, a tyre cannot pull on the road: its load is never below 0. Off, as in the paper, it can.
             * @default false
             */
            tyre_lift_off: boolean;
        };
        /**
         * VehicleAnswer
         * @description A vehicle with its sources; one track of the car, as every half-car here.
         */
        VehicleAnswer: {
            /**
             * Derived
             * @description How those follow that no source has
             */
            derived: string[];
            /** Description */
            description: string;
            /** Id */
            id: string;
            /** Label */
            label: string;
            /**
             * Sources
             * @description Where its numbers are from
             */
            sources: string[];
            vehicle: components["schemas"]["Vehicle"];
        };
        /**
         * WithoutPreview
         * @description The counts of verdicts without preview.
         */
        WithoutPreview: {
            counts: components["schemas"]["Counts"];
            /** Reached */
            reached: number;
        };
    };
    responses: never;
    parameters: never;
    requestBodies: never;
    headers: {
        /** @description A file's name; not of JSON */
        "Content-Disposition": string;
        /** @description For If-None-Match */
        ETag: string;
        /** @description Where it is */
        Location: string;
        /** @description When to ask again [s] */
        "Retry-After": number;
        /** @description The page's cookie, HttpOnly and SameSite=Strict */
        "Set-Cookie": string;
        /** @description `Bearer` */
        "WWW-Authenticate": string;
        /** @description The request's name, also in the service's log */
        "X-Request-ID": string;
    };
    pathItems: never;
}
export type $defs = Record<string, never>;
export interface operations {
    listBatches: {
        parameters: {
            query?: {
                /** @description `next` of the page before */
                cursor?: string | null;
                /** @description Only those with that label */
                label?: string | null;
                /** @description At most so many */
                limit?: number;
                /** @description Only those in that state */
                state?: ("queued" | "running" | "done" | "cancelled" | "failed") | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The newest first, page by page. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Batches"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createBatch: {
        parameters: {
            query?: never;
            header?: {
                /** @description The same key and body again answer the same job, so that a lost answer can be asked for again; after it was cancelled they begin a new one */
                "idempotency-key"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["BatchRequest"];
            };
        };
        responses: {
            /** @description Of a dry run */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Estimate"];
                };
            };
            /** @description Submit a sweep; 202 comes after the commit: what was accepted completes, whatever crashes. */
            202: {
                headers: {
                    Location: components["headers"]["Location"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Batch"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `idempotency-key-reused`: The Idempotency-Key came with another request before. `not-ended`: A tuning that still runs cannot get another number of trials: cancel it first. `done`: Nothing is left to do; a tuning goes on with a greater number of trials. `not-deletable`: It has not ended, or a link shows it. */
            409: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getBatch: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The job's present state; its events report changes. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Batch"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    deleteBatch: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Remove one that has ended and that no link shows; with tokens only its owner may. */
            204: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `forbidden`: The proxy before the service does not pass this request on. `cross-site`: Another site's page sent this request through a browser, and it would change something. `other-token`: It belongs to another token, which alone may change it. */
            403: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `idempotency-key-reused`: The Idempotency-Key came with another request before. `not-ended`: A tuning that still runs cannot get another number of trials: cancel it first. `done`: Nothing is left to do; a tuning goes on with a greater number of trials. `not-deletable`: It has not ended, or a link shows it. */
            409: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    labelBatch: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["LabelRequest"];
            };
        };
        responses: {
            /** @description Name it, or take its name away. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Batch"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    cancelBatch: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Cancel it; finished runs stay. One that has ended is answered unchanged. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Batch"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getBatchEvents: {
        parameters: {
            query?: {
                /** @description The same, in the address */
                after?: number;
            };
            header?: {
                /** @description The last number seen: a browser sends it */
                "last-event-id"?: string | null;
            };
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Server-sent events; the last one is the final state. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "text/event-stream": {
                        /** @description JSON: state, done, failed, total */
                        data: string;
                        /** @enum {unknown} */
                        event: "state" | "progress";
                        id: string;
                    };
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getBatchResults: {
        parameters: {
            query?: {
                /** @description Of it */
                format?: "json" | "csv" | "parquet";
            };
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description One row a run, in order, streamed; a batch that still runs has rows that wait. */
            200: {
                headers: {
                    "Content-Disposition": components["headers"]["Content-Disposition"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["BatchResults"];
                    "application/vnd.apache.parquet": unknown;
                    "text/csv": unknown;
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    resumeBatch: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A cancelled one goes on where it stopped; one under way is answered as it is. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Batch"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `idempotency-key-reused`: The Idempotency-Key came with another request before. `not-ended`: A tuning that still runs cannot get another number of trials: cancel it first. `done`: Nothing is left to do; a tuning goes on with a greater number of trials. `not-deletable`: It has not ended, or a link shows it. */
            409: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getBatchSummary: {
        parameters: {
            query?: {
                /** @description Strategy; without one LV, else the first */
                baseline?: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive") | null;
                /** @description Keys with commas; without any the paper's eight, travel exceeded and airborne */
                figures?: string;
            };
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Each figure's quantiles and extremes under each strategy, paired margins, what they follow, and stability. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["BatchSummary"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getBatchTable: {
        parameters: {
            query?: {
                /** @description Keys with commas, such as bump.body_acceleration.peak */
                figures?: string;
            };
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Rows column by column: run, strategy, status, reason, the swept fields and the figures asked for. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["BatchTable"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getCatalogue: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Signals, windows, statistics, stages, comfort, events, references: keys, labels and units. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Catalogue"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    exportController: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ControllerRequest"];
            };
        };
        responses: {
            /** @description A zip with README, Makefile and C sources */
            200: {
                headers: {
                    "Content-Disposition": components["headers"]["Content-Disposition"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/zip": unknown;
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    driveByClock: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ControllerRequest"];
            };
        };
        responses: {
            /** @description Drive it once by the clock: latency, jitter, missed deadlines; takes as long as the drive, one at a time. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RealtimeReport"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    reportController: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ControllerRequest"];
            };
        };
        responses: {
            /** @description Whether it fits an STM32F103, and which smaller controllers do; takes about ten seconds, one at a time. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ControllerReport"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getFigures: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Figure templates in the order of display: layout, and a trace without data for each strategy. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Figures"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createLink: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["LinkRequest"];
            };
        };
        responses: {
            /** @description Share a stored run or a batch; the answer comes after the commit. */
            201: {
                headers: {
                    Location: components["headers"]["Location"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["CreatedLink"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getLink: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters; anything else is 404 */
                slug: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description What a link opens: results as they were computed, the scenario as today's schema has it, the view. */
            200: {
                headers: {
                    ETag: components["headers"]["ETag"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Link"];
                };
            };
            /** @description Not changed */
            304: {
                headers: {
                    ETag: components["headers"]["ETag"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    live: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["LiveRequest"];
            };
        };
        responses: {
            /** @description Figures and decimated time histories while somebody drags; nothing is stored. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LiveRun"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getLogin: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Whether the service wants a token. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LoginState"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    logIn: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["LoginRequest"];
            };
        };
        responses: {
            /** @description Keep the token in a cookie that no script can read; 401 where it is none of the service's. */
            204: {
                headers: {
                    "Set-Cookie": components["headers"]["Set-Cookie"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    logOut: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Forget the cookie. */
            204: {
                headers: {
                    "Set-Cookie": components["headers"]["Set-Cookie"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getPaper: {
        parameters: {
            query?: {
                /** @description Braking pitches the body: Eq. 7 has no such term, though the brake stage exists to hold the pitch it causes. By default as the interpretation has it. */
                braking_moment?: ("on" | "off") | null;
                /** @description The first road's seed; the others follow it */
                first_seed?: number;
                /** @description Actuator force limit: The paper gives none. By default as the interpretation has it. */
                force_limit?: ("5" | "2.5" | "10" | "20") | null;
                /** @description A named set of readings; single ones beside it override it */
                interpretation?: "default" | "favourable";
                /** @description Preview for LQR too: The paper's LQR has none. With the same preview it is the fairer opponent. By default as the interpretation has it. */
                lqr_preview?: ("lookahead" | "obstacle" | "wheelbase" | "none") | null;
                /** @description Answer at once with the cells that are there; the others are `pending` */
                partial?: boolean;
                /** @description Road preview: Eq. 9 predicts without the road; section 3.1 lets sensors see the bump. What the MPC knows of the road ahead decides most of the paper's claims. By default as the interpretation has it. */
                preview?: ("lookahead" | "obstacle" | "wheelbase" | "none") | null;
                /** @description End of the road: Eq. 3 ends the road at 110 m; ours goes on to 150 m so that the car settles. By default as the interpretation has it. */
                road_end?: ("150" | "110") | null;
                /** @description Control interval: The paper does not give it. By default as the interpretation has it. */
                sample_time?: ("10" | "5" | "20") | null;
                /** @description How many roads every strategy drives */
                seeds?: number;
                /** @description Travel limit: Eq. 14 names a limit of the deflection, f_dmax; the paper gives no value. By default as the interpretation has it. */
                travel_limit?: ("80" | "100") | null;
                /** @description Travel weight q4: A weight on suspension travel is ours. Without it an LQR uses far more travel than a car has. By default as the interpretation has it. */
                travel_weight?: ("3" | "0") | null;
                /** @description Table 2's car: Its masses look like a whole car's, its stiffnesses like one wheel's. By default as the interpretation has it. */
                vehicle?: ("printed" | "half") | null;
                /** @description Where the RMS are taken: Section 4.1.1 takes the RMS on the graded road surface, section 4.2.2 over the full course. By default as the interpretation has it. */
                window?: ("to_bump" | "class_b" | "full_course") | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Every printed change of Tables 4-5 and 7-10 with ours and a verdict; readings by name of a set or singly. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PaperAnswer"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getPaperAttribution: {
        parameters: {
            query?: {
                /** @description The first road's seed; the others follow it */
                first_seed?: number;
                /** @description How many roads every strategy drives */
                seeds?: number;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Preview, weights and speed varied one at a time, and how much of LV's gain each is. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AttributionAnswer"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getPaperFigures: {
        parameters: {
            query?: {
                /** @description The first road's seed; the others follow it */
                first_seed?: number;
                /** @description How many roads every strategy drives */
                seeds?: number;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Figures 3-6, 8, 10-17 and 19-22 from our own runs. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PaperFigures"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getPaperReadings: {
        parameters: {
            query?: {
                /** @description The first road's seed; the others follow it */
                first_seed?: number;
                /** @description How many roads every strategy drives */
                seeds?: number;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description What each reading does to the verdicts by itself; ask again while it is not complete. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ReadingsAnswer"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getPaperReport: {
        parameters: {
            query?: {
                /** @description Braking pitches the body: Eq. 7 has no such term, though the brake stage exists to hold the pitch it causes. By default as the interpretation has it. */
                braking_moment?: ("on" | "off") | null;
                /** @description The first road's seed; the others follow it */
                first_seed?: number;
                /** @description Actuator force limit: The paper gives none. By default as the interpretation has it. */
                force_limit?: ("5" | "2.5" | "10" | "20") | null;
                /** @description A named set of readings; single ones beside it override it */
                interpretation?: "default" | "favourable";
                /** @description Preview for LQR too: The paper's LQR has none. With the same preview it is the fairer opponent. By default as the interpretation has it. */
                lqr_preview?: ("lookahead" | "obstacle" | "wheelbase" | "none") | null;
                /** @description Road preview: Eq. 9 predicts without the road; section 3.1 lets sensors see the bump. What the MPC knows of the road ahead decides most of the paper's claims. By default as the interpretation has it. */
                preview?: ("lookahead" | "obstacle" | "wheelbase" | "none") | null;
                /** @description End of the road: Eq. 3 ends the road at 110 m; ours goes on to 150 m so that the car settles. By default as the interpretation has it. */
                road_end?: ("150" | "110") | null;
                /** @description Control interval: The paper does not give it. By default as the interpretation has it. */
                sample_time?: ("10" | "5" | "20") | null;
                /** @description How many roads every strategy drives */
                seeds?: number;
                /** @description Travel limit: Eq. 14 names a limit of the deflection, f_dmax; the paper gives no value. By default as the interpretation has it. */
                travel_limit?: ("80" | "100") | null;
                /** @description Travel weight q4: A weight on suspension travel is ours. Without it an LQR uses far more travel than a car has. By default as the interpretation has it. */
                travel_weight?: ("3" | "0") | null;
                /** @description Table 2's car: Its masses look like a whole car's, its stiffnesses like one wheel's. By default as the interpretation has it. */
                vehicle?: ("printed" | "half") | null;
                /** @description Where the RMS are taken: Section 4.1.1 takes the RMS on the graded road surface, section 4.2.2 over the full course. By default as the interpretation has it. */
                window?: ("to_bump" | "class_b" | "full_course") | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description All of this as one HTML file that needs nothing else; each reading may be chosen for its tables. */
            200: {
                headers: {
                    "Content-Disposition": components["headers"]["Content-Disposition"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "text/html": string;
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getPresets: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Named scenarios; the paper's first. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PresetAnswer"][];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createRoad: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example distance [m],height [mm]
                 *     0,0
                 *     5,12
                 *     10,3
                 */
                "text/csv": string;
            };
        };
        responses: {
            /** @description Store a measured profile: distance and height, or left and right height, each column's unit in the header. */
            201: {
                headers: {
                    Location: components["headers"]["Location"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["CreatedRoad"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getRoad: {
        parameters: {
            query?: {
                /** @description About how many heights */
                points?: number;
            };
            header?: never;
            path: {
                /** @description Of the road */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A measured road; it never changes. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RoadAnswer"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getRobustnessDefaults: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The uncertain fields of a robustness study by default: a batch over these ranges, read by its summary. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RobustnessDefaults"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createRun: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["RunRequest"];
            };
        };
        responses: {
            /** @description Run what is not stored yet, on one road or several; the answer comes after the commit. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["CreatedRun"] | components["schemas"]["CreatedRoadsRun"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getRun: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A stored run; it changes only where its results were removed and another core version computes them again. */
            200: {
                headers: {
                    ETag: components["headers"]["ETag"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Run"] | components["schemas"]["RoadsRun"];
                };
            };
            /** @description Not changed */
            304: {
                headers: {
                    ETag: components["headers"]["ETag"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getBands: {
        parameters: {
            query?: {
                /** @description Of numbers */
                encoding?: "list" | "base64";
                /** @description About how many samples; omitted is all */
                points?: number | null;
                /** @description Keys with commas; omitted is all */
                signals?: string | null;
                /** @description Ids with commas; omitted is all of the run's */
                strategy?: string | null;
            };
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Of a run over several roads: mean, smallest and largest value over all roads at each sample, in SI units. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Bands"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `other-core-version`: Another version computed the run, and its time histories are gone; its metrics stay. `road-gone`: The measured road of the run is not stored any more; send its file again. */
            410: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getChanges: {
        parameters: {
            query: {
                /** @description Id of a run over the same roads */
                against: string;
            };
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description What a run over several roads changes against another run: paired by road, strategy by strategy. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PairedChanges"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getRunFigures: {
        parameters: {
            query?: {
                /** @description What is on the x axis */
                x?: "position" | "time";
            };
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Every figure with this run's data. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Figures"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `other-core-version`: Another version computed the run, and its time histories are gone; its metrics stay. `road-gone`: The measured road of the run is not stored any more; send its file again. */
            410: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getRunFigure: {
        parameters: {
            query?: {
                /** @description What is on the x axis */
                x?: "position" | "time";
            };
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
                /** @description Of the figure */
                name: "road" | "body_acceleration" | "front_tyre_load" | "pitch_acceleration" | "rear_tyre_load" | "front_deflection" | "rear_deflection" | "front_force" | "rear_force" | "speed" | "brake_pressure";
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description One figure with this run's data. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": {
                        [key: string]: unknown;
                    };
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `other-core-version`: Another version computed the run, and its time histories are gone; its metrics stay. `road-gone`: The measured road of the run is not stored any more; send its file again. */
            410: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getRunReport: {
        parameters: {
            query?: {
                /** @description A run they refer to instead, by strategy */
                against?: string | null;
                /** @description Whose figures the changes refer to; omitted is passive */
                baseline?: ("lv" | "lv_hil" | "lqr" | "skyhook" | "groundhook" | "hybrid" | "suspension_only" | "speed_only" | "passive") | null;
                /** @description What is on the x axis */
                x?: "position" | "time";
            };
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The run as one HTML file that needs nothing else; its figures are inside, or it says why there are none. */
            200: {
                headers: {
                    "Content-Disposition": components["headers"]["Content-Disposition"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "text/html": string;
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getSeries: {
        parameters: {
            query?: {
                /** @description Of JSON only */
                encoding?: "list" | "base64";
                /** @description Of it */
                format?: "json" | "csv" | "parquet";
                /** @description About how many samples; omitted is all */
                points?: number | null;
                /** @description Keys with commas; omitted is all */
                signals?: string | null;
                /** @description Ids with commas; may be omitted where the run has one */
                strategy?: string | null;
            };
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Time histories in SI units; time and position always come along. */
            200: {
                headers: {
                    "Content-Disposition": components["headers"]["Content-Disposition"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Series"] | components["schemas"]["SeriesOfSeveral"];
                    "application/vnd.apache.parquet": unknown;
                    "text/csv": unknown;
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `other-core-version`: Another version computed the run, and its time histories are gone; its metrics stay. `road-gone`: The measured road of the run is not stored any more; send its file again. */
            410: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getSchema: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description JSON Schema of the scenario: title, description, unit, default, hard limits and soft_range of each field. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": {
                        [key: string]: unknown;
                    };
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    solve: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["SolveRequest"];
            };
        };
        responses: {
            /** @description The largest value of one field that keeps one metric at or below a limit, and the run at that value. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Solution"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getStrategies: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Every strategy: what it does, what it reads, how it is drawn. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["StrategyAnswer"][];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listTunings: {
        parameters: {
            query?: {
                /** @description `next` of the page before */
                cursor?: string | null;
                /** @description Only those with that label */
                label?: string | null;
                /** @description At most so many */
                limit?: number;
                /** @description Only those in that state */
                state?: ("queued" | "running" | "done" | "cancelled" | "failed") | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The newest first, page by page. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Tunings"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createTuning: {
        parameters: {
            query?: never;
            header?: {
                /** @description The same key and body again answer the same job, so that a lost answer can be asked for again; after it was cancelled they begin a new one */
                "idempotency-key"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["TuningRequest"];
            };
        };
        responses: {
            /** @description Of a dry run */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TuningEstimate"];
                };
            };
            /** @description Begin to look for better weights; 202 comes after the commit: what was accepted completes, whatever crashes. */
            202: {
                headers: {
                    Location: components["headers"]["Location"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Tuning"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `idempotency-key-reused`: The Idempotency-Key came with another request before. `not-ended`: A tuning that still runs cannot get another number of trials: cancel it first. `done`: Nothing is left to do; a tuning goes on with a greater number of trials. `not-deletable`: It has not ended, or a link shows it. */
            409: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getTuning: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The job's present state; its events report changes. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Tuning"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    deleteTuning: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Remove one that has ended and that no link shows; with tokens only its owner may. */
            204: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `forbidden`: The proxy before the service does not pass this request on. `cross-site`: Another site's page sent this request through a browser, and it would change something. `other-token`: It belongs to another token, which alone may change it. */
            403: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `idempotency-key-reused`: The Idempotency-Key came with another request before. `not-ended`: A tuning that still runs cannot get another number of trials: cancel it first. `done`: Nothing is left to do; a tuning goes on with a greater number of trials. `not-deletable`: It has not ended, or a link shows it. */
            409: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    labelTuning: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["LabelRequest"];
            };
        };
        responses: {
            /** @description Name it, or take its name away. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Tuning"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    cancelTuning: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Cancel it; finished runs stay. One that has ended is answered unchanged. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Tuning"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getTuningEvents: {
        parameters: {
            query?: {
                /** @description The same, in the address */
                after?: number;
            };
            header?: {
                /** @description The last number seen: a browser sends it */
                "last-event-id"?: string | null;
            };
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Server-sent events; the last one is the final state. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "text/event-stream": {
                        /** @description JSON: state, step, generation, total, done, failed, feasible; progress also best and hypervolume */
                        data: string;
                        /** @enum {unknown} */
                        event: "state" | "progress" | "restart";
                        id: string;
                    };
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-many-requests`: One client has too much open or asks too often. */
            429: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    resumeTuning: {
        parameters: {
            query?: {
                /** @description In all; without it as many as were asked for before */
                trials?: number | null;
            };
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description One that has ended goes on where it stopped, perhaps with more trials; one under way is answered as it is. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Tuning"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `idempotency-key-reused`: The Idempotency-Key came with another request before. `not-ended`: A tuning that still runs cannot get another number of trials: cancel it first. `done`: Nothing is left to do; a tuning goes on with a greater number of trials. `not-deletable`: It has not ended, or a link shows it. */
            409: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getTuningTrials: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description 22 characters */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Every trial of the complete generations, in order. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Trials"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `not-found`: There is nothing at this address, or nothing of this id. */
            404: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unavailable`: The service, or the proxy before it, cannot answer now. `full`: The service has too much to do at the moment. `connections`: Too many connections are open, of this client or of all. `store-unavailable`: The database does not answer. `worker-lost`: The computation ended unexpectedly, twice. `newer-schema`: A newer version of the service stored this; it is being updated. `ecu-unavailable`: The ECU's program cannot be built here; detail names the remedy, and waiting is none. `not-built`: The dashboard's files are not there. The API answers. */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getVehicles: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Vehicles with their sources, as a scenario's `vehicle`. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["VehicleAnswer"][];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    makeHalfCar: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["DataSheet"];
            };
        };
        responses: {
            /** @description The half-car of a whole car's data sheet: masses, axle loads, natural frequencies, damping ratios. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HalfCarAnswer"];
                };
            };
            /** @description `malformed-request`: The request could not be read. `two-lengths`: The request has both Content-Length and Transfer-Encoding. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            400: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `token-required`: The service answers those with a token: Authorization: Bearer, or the page's login. */
            401: {
                headers: {
                    "WWW-Authenticate": components["headers"]["WWW-Authenticate"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `slow-body`: The request body did not come in time. `slow-head`: The request's head did not come in time. */
            408: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `too-long`: The request body is longer than allowed. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            413: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `unsupported-media-type`: The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv. */
            415: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `invalid-request`: The request has values that cannot be used; errors names each. `refused`: The values fit one by one, but the simulation cannot work with them together. `unknown`: The body names a run, a batch or a road that is not there, or a field it does not sweep. `cost-limit`: The estimated cost or the number of runs is over the limit. `too-expensive`: A run takes more computing than one may; errors names what to change. `no-solution`: No value in the range keeps the limit. `strict-json`: The body is not JSON (400), holds too many values (413), or something that two readers may understand differently (422): a key twice, NaN, an integer no double holds. */
            422: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `internal-error`: Something went wrong in the service. It is in its log. */
            500: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getHealth: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The process answers. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Health"];
                };
            };
        };
    };
    getMetrics: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Figures for Prometheus: counts, gauges and latencies, nothing of anybody's scenario. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/openmetrics-text": unknown;
                    "text/plain": string;
                };
            };
        };
    };
    getReadiness: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The store answers and a warm worker is there. */
            200: {
                headers: {
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Readiness"];
                };
            };
            /** @description Not yet, or not now */
            503: {
                headers: {
                    "Retry-After": components["headers"]["Retry-After"];
                    "X-Request-ID": components["headers"]["X-Request-ID"];
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Readiness"];
                };
            };
        };
    };
}
