/** The icons in use; iconShapes.LICENSE says whose shapes they are. */

import shapes from "./iconShapes.json";
import type { ComponentType, SVGProps } from "react";

export const IconAdjustments = icon(shapes.Adjustments);
export const IconAdjustmentsHorizontal = icon(shapes.AdjustmentsHorizontal);
export const IconAlertTriangle = icon(shapes.AlertTriangle);
export const IconArrowBackUp = icon(shapes.ArrowBackUp);
export const IconArrowDownRight = icon(shapes.ArrowDownRight);
export const IconArrowForwardUp = icon(shapes.ArrowForwardUp);
export const IconArrowRight = icon(shapes.ArrowRight);
export const IconArrowsSort = icon(shapes.ArrowsSort);
export const IconBraces = icon(shapes.Braces);
export const IconBrandPython = icon(shapes.BrandPython);
export const IconCheck = icon(shapes.Check);
export const IconChevronDown = icon(shapes.ChevronDown);
export const IconChevronUp = icon(shapes.ChevronUp);
export const IconCopy = icon(shapes.Copy);
export const IconCpu = icon(shapes.Cpu);
export const IconDots = icon(shapes.Dots);
export const IconDownload = icon(shapes.Download);
export const IconEqual = icon(shapes.Equal);
export const IconExternalLink = icon(shapes.ExternalLink);
export const IconEyeOff = icon(shapes.EyeOff);
export const IconFileDescription = icon(shapes.FileDescription);
export const IconFileText = icon(shapes.FileText);
export const IconFileTypeCsv = icon(shapes.FileTypeCsv);
export const IconGauge = icon(shapes.Gauge);
export const IconGridDots = icon(shapes.GridDots);
export const IconHelp = icon(shapes.Help);
export const IconLink = icon(shapes.Link);
export const IconLock = icon(shapes.Lock);
export const IconLogout = icon(shapes.Logout);
export const IconMaximize = icon(shapes.Maximize);
export const IconMinus = icon(shapes.Minus);
export const IconMoon = icon(shapes.Moon);
export const IconPhoto = icon(shapes.Photo);
export const IconPin = icon(shapes.Pin);
export const IconPlayerPauseFilled = icon(shapes.PlayerPauseFilled, { filled: true });
export const IconPlayerPlayFilled = icon(shapes.PlayerPlayFilled, { filled: true });
export const IconPlugConnected = icon(shapes.PlugConnected);
export const IconPlugConnectedX = icon(shapes.PlugConnectedX);
export const IconPlus = icon(shapes.Plus);
export const IconRefresh = icon(shapes.Refresh);
export const IconRestore = icon(shapes.Restore);
export const IconSearch = icon(shapes.Search);
export const IconSortAscending = icon(shapes.SortAscending);
export const IconSortDescending = icon(shapes.SortDescending);
export const IconSun = icon(shapes.Sun);
export const IconTable = icon(shapes.Table);
export const IconTemplate = icon(shapes.Template);
export const IconTerminal2 = icon(shapes.Terminal2);
export const IconWorldUpload = icon(shapes.WorldUpload);
export const IconX = icon(shapes.X);

interface IconProps extends Omit<SVGProps<SVGSVGElement>, "stroke"> {
  /** Width and height [px]. */
  readonly size?: number;
  /** Width of its lines, of 24 across. */
  readonly stroke?: number;
}

/** The icon of a path in a square of 24, drawn with lines or filled, in the colour of the text around it. */
function icon(path: string, { filled = false } = {}): ComponentType<IconProps> {
  const paint = filled ? { fill: "currentColor" } : { fill: "none", stroke: "currentColor" };
  return function Icon({ size = 24, stroke = 2, ...rest }) {
    return (
      <svg
        viewBox="0 0 24 24"
        width={size}
        height={size}
        strokeWidth={filled ? undefined : stroke}
        strokeLinecap="round"
        strokeLinejoin="round"
        {...paint}
        {...rest}
      >
        <path d={path} />
      </svg>
    );
  };
}
