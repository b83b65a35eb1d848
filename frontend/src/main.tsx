import { MantineProvider } from "@mantine/core";
// In a layer: ours wins whatever order the build puts the styles of its chunks in.
import "@mantine/core/styles.layer.css";
import { QueryClient, QueryClientProvider } from "@tanstack/react-query";
import { StrictMode, Suspense } from "react";
import { createRoot } from "react-dom/client";
import { api } from "./api/client";
import { App } from "./App";
import { LazyBatchPage } from "./batch/lazy";
import "./global.css";
import { pageAt } from "./pages";
import { loadPlotly } from "./plots/plotly";
import { ErrorBoundary } from "./shell/ErrorBoundary";
import { LoginGate } from "./shell/LoginGate";
import { createLab } from "./state/lab";
import { watchPrinting } from "./state/printing";
import { createRouter } from "./state/router";
import { theme } from "./theme";

const queries = new QueryClient({
  // A local server needs no network, and asking again is the connection banner's work.
  defaultOptions: { queries: { retry: false, networkMode: "always", refetchOnWindowFocus: false } },
});

/** A sweep has a page of its own, which needs nothing of the dashboard. */
const batchId = /^\/b\/([^/]+)\/?$/.exec(window.location.pathname)?.[1];

function dashboard() {
  const router = createRouter();
  const lab = createLab({ api, router, queries });
  // The first run, the plotting code and the form are fetched at the same time.
  lab.open(router.get());
  router.onTravel(lab.travel);
  return <App lab={lab} router={router} />;
}

function content() {
  if (batchId !== undefined) return <LazyBatchPage id={batchId} />;
  const page = pageAt(window.location.pathname);
  return page ? <page.View id={page.id} /> : dashboard();
}

const page = content();
void loadPlotly();
watchPrinting();

const root = document.getElementById("root");
if (!root) throw new Error("index.html has no #root");
createRoot(root).render(
  <StrictMode>
    <QueryClientProvider client={queries}>
      <MantineProvider theme={theme} defaultColorScheme="auto">
        <ErrorBoundary>
          <Suspense>
            <LoginGate>{page}</LoginGate>
          </Suspense>
        </ErrorBoundary>
      </MantineProvider>
    </QueryClientProvider>
  </StrictMode>,
);
