// How long tests wait for what a page shows: they run behind everything else on a busy machine.
import { configure } from "@testing-library/react";

configure({ asyncUtilTimeout: 60_000 });
