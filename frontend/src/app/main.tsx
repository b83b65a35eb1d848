import { MantineProvider } from "@mantine/core";
import "./mantine.css";
import { QueryClientProvider } from "@tanstack/react-query";
import { RouterProvider } from "@tanstack/react-router";
import { StrictMode } from "react";
import { createRoot } from "react-dom/client";
import { api } from "../api/client";
import { loadPinned, ownPins } from "../features/compare/usePins";
import "./global.css";
import { ownLibrary } from "../scenario/ownLibrary";
import { createAppRouter } from "./router";
import { LabContextProvider } from "../lab/context";
import { createLab } from "../lab/lab";
import { createQueryClient } from "../server/queryClient";
import { restoreBefore, restoreTab, storeTab } from "../lab/reload";
import { storeSession, restoreSession } from "../lab/session";
import { watchPrinting } from "../lib/printing";
import { createLabRouter, startsAnew } from "../lab/labAddress";
import { theme } from "./theme";

const queries = createQueryClient();

// The lab lives as long as the tab: other pages come and go beside it.
const pages = createAppRouter();
// An address that names a result opens that, and nothing is behind it.
const restored = startsAnew(pages) ? restoreSession() : null;
const router = createLabRouter(pages, restored?.view);
const tab = restoreTab({ runId: router.get().runId, scenario: restored?.lab.history?.present ?? null });
const lab = createLab({ api, router, queries }, { ...restored?.lab, ...(tab && { history: tab.history }) });
if (tab) restoreBefore(lab, tab, (run) => loadPinned(run, null, queries, new AbortController().signal));
storeSession(lab, router);
storeTab(lab);
router.onNavigate(lab.navigate);
watchPrinting();
const readOwn = () => {
  ownLibrary.refresh();
  ownPins.refresh();
};
window.addEventListener("storage", readOwn); // another tab has changed them
window.addEventListener("pageshow", readOwn); // or may have while the browser kept this page aside

const context = { lab, router, standard: {}, restored: restored?.lab.history?.present ?? null };

const root = document.getElementById("root");
if (!root) throw new Error("index.html has no #root");
createRoot(root).render(
  <StrictMode>
    <QueryClientProvider client={queries}>
      <MantineProvider theme={theme} defaultColorScheme="auto">
        <LabContextProvider value={context}>
          <RouterProvider router={pages} />
        </LabContextProvider>
      </MantineProvider>
    </QueryClientProvider>
  </StrictMode>,
);
