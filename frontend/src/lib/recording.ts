/** Whether a strategy is a recorded drive, which nothing simulates. */
export const isRecording = (strategy: string): boolean => strategy.startsWith("recording:");
