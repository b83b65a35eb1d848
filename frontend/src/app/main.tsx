import { MantineProvider, createTheme, type MantineColorsTuple } from "@mantine/core";
import { QueryClientProvider } from "@tanstack/react-query";
import { RouterProvider } from "@tanstack/react-router";
import { StrictMode } from "react";
import { createRoot } from "react-dom/client";
import "./mantine.css";
import { api } from "../api/client";
import { ownPins } from "../features/compare/useCompared";
import "./global.css";
import { galleryEntry, ownLibrary } from "../scenario/library";
import { createAppRouter } from "./router";
import { LabContextProvider } from "../lab/context";
import { createLab } from "../lab/lab";
import { createQueryClient } from "../server/queries";
import { storeSession, restoreSession } from "../lab/session";
import { watchPrinting } from "../lib/printing";
import { createLabAddress, startsAnew } from "../lab/labAddress";

// The darkest is text, the third what is under it where it is pointed at: more than the 4.5 times as bright that are needed.
const petrol: MantineColorsTuple = [
  "#e3f5f5",
  "#cde9e9",
  "#c0e3e3",
  "#6abcbd",
  "#42a9aa",
  "#289d9e",
  "#159798",
  "#008484",
  "#007677",
  "#00696b",
];

const small = { defaultProps: { size: "xs" } };

const theme = createTheme({
  primaryColor: "petrol",
  // White text stands out on either.
  primaryShade: { light: 9, dark: 8 },
  autoContrast: true,
  colors: { petrol },
  defaultRadius: "sm",
  cursorType: "pointer",
  fontFamily: "Inter, system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif",
  headings: { fontWeight: "650" },
  fontSizes: { xs: "0.75rem", sm: "0.8125rem", md: "0.875rem", lg: "1.0625rem", xl: "1.25rem" },
  respectReducedMotion: true,
  components: {
    Button: { defaultProps: { size: "xs", variant: "default" } },
    Checkbox: small,
    MultiSelect: small,
    NativeSelect: small,
    SegmentedControl: small,
    Select: small,
    TextInput: small,
    // The placeholder would be a child that a menu may not have.
    Modal: { defaultProps: { closeButtonProps: { "aria-label": "Close" }, styles: { title: { fontWeight: 650 } } } },
    // The page has one banner: its own header.
    ModalHeader: { defaultProps: { role: "none" } },
    DrawerHeader: { defaultProps: { role: "none" } },
    Menu: { defaultProps: { withInitialFocusPlaceholder: false } },
    // What pulses is drawn 60 times a second while the page has enough to do.
    Skeleton: { defaultProps: { animate: false } },
    // The choices of a closed list take a tenth of the page.
    Combobox: { defaultProps: { keepMounted: false } },
  },
});

const queries = createQueryClient();

// The lab lives as long as the tab: other pages come and go beside it.
const pages = createAppRouter(queries);
const named = new URLSearchParams(window.location.search).get("gallery");
galleryEntry.set(named === "" ? null : named);
// An address that names a result opens that, and nothing is behind it.
const restored = startsAnew(pages) ? restoreSession() : null;
const labAddress = createLabAddress(pages, restored?.view);
const lab = createLab({ api, labAddress, queries }, { ...restored?.lab });
storeSession(lab, labAddress);
labAddress.onNavigate(lab.navigate);
watchPrinting();
const readOwn = () => {
  ownLibrary.refresh();
  ownPins.refresh();
};
window.addEventListener("storage", readOwn); // another tab has changed them
window.addEventListener("pageshow", readOwn); // or may have while the browser kept this page aside

const context = { lab, labAddress, restored: restored?.lab.history?.present ?? null };

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
