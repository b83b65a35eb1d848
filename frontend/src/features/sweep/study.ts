/** By this name a sweep is a robustness study. */
export const STUDY_LABEL = "Robustness study";
