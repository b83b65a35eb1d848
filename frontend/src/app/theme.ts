import { createTheme, Menu, type MantineColorsTuple } from "@mantine/core";

const petrol: MantineColorsTuple = [
  "#e3f5f5",
  "#cde9e9",
  "#9dd3d3",
  "#6abcbd",
  "#42a9aa",
  "#289d9e",
  "#159798",
  "#008484",
  "#007677",
  "#00696b",
];

export const theme = createTheme({
  primaryColor: "petrol",
  // White text stands out on either.
  primaryShade: { light: 9, dark: 8 },
  autoContrast: true,
  colors: { petrol },
  defaultRadius: "sm",
  cursorType: "pointer",
  fontFamily: "Inter, system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif",
  headings: { fontWeight: "650" },
  respectReducedMotion: true,
  components: {
    // The placeholder would be a child that a menu may not have.
    Menu: Menu.extend({ defaultProps: { withInitialFocusPlaceholder: false } }),
  },
});
