"""Print every figure, the core's, then the service's; or only those of the parts that are named."""

import argparse

from benchmarks import acceptance, api_latency, batches, core, first_view, path

PARTS = {
    "core": core.run,
    "api_latency": api_latency.run,
    "acceptance": acceptance.run,
    "first_view": first_view.run,
    "batches": batches.run,
    "path": path.run,
}

if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description="Speed, as ratios in one run.")
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"of {', '.join(PARTS)}; all by default")
    names = parser.parse_args().parts or list(PARTS)
    if unknown := set(names) - PARTS.keys():
        parser.error(f"there is no {', '.join(sorted(unknown))}; there are {', '.join(PARTS)}")
    for name in names:
        PARTS[name]()
