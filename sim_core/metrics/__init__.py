"""What a run is judged by: windows, integrals, peaks, comfort."""
