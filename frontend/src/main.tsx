import { MantineProvider } from "@mantine/core";
import "./mantine.css";
import { QueryClient, QueryClientProvider } from "@tanstack/react-query";
import { RouterProvider } from "@tanstack/react-router";
import { StrictMode } from "react";
import { createRoot } from "react-dom/client";
import { api } from "./api/client";
import "./global.css";
import { ownLibrary } from "./library/ownLibrary";
import { createAppRouter } from "./router";
import { LabContextProvider } from "./state/context";
import { createLab } from "./state/lab";
import { storeSession, restoreSession } from "./state/session";
import { watchPrinting } from "./state/printing";
import { createLabRouter, startsAnew } from "./state/router";
import { theme } from "./theme";

const queries = new QueryClient({
  // A local server needs no network, and asking again is the connection banner's work.
  defaultOptions: { queries: { retry: false, networkMode: "always", refetchOnWindowFocus: false } },
});

// The lab lives as long as the tab: other pages come and go beside it.
const pages = createAppRouter();
// An address that names a result opens that, and nothing is behind it.
const restored = startsAnew(pages) ? restoreSession() : null;
const router = createLabRouter(pages, restored?.view);
const lab = createLab({ api, router, queries }, restored?.lab);
router.onNavigate(lab.navigate);
storeSession(lab, router);
watchPrinting();
window.addEventListener("storage", ownLibrary.refresh); // another tab has changed it

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
