/** What may not be exceeded on any training road. */

import { fullName, type Figure } from "../../server/metrics";
import type { DraftErrors } from "../../features/jobForm/problems";
import { limitOf, MOST_LIMITS, type LimitDraft } from "./draft";
import { FigureSelect } from "./FigureSelect";
import classes from "./tuner.module.css";
import ui from "../../ui/ui.module.css";
import { Entry } from "../../ui/Entry";
import { EntryRow } from "../../ui/EntryRow";

interface Props {
  readonly limits: readonly LimitDraft[];
  readonly figures: readonly Figure[];
  readonly errors: DraftErrors;
  readonly onChange: (limits: readonly LimitDraft[]) => void;
}

export function LimitRows({ limits, figures, errors, onChange }: Props) {
  return (
    <div className={ui.stack}>
      {limits.map(({ figure: name, atMost }, index) => {
        const figure = figures.find(({ key }) => key === name);
        const title = figure ? fullName(figure) : name;
        const error = errors[`limits.${index}`];
        return (
          <EntryRow
            key={name}
            title={title}
            name={`Limit: ${title}`}
            removal={`the limit of ${title}`}
            error={error}
            onRemove={() => onChange(limits.filter((each) => each.figure !== name))}
            beside={
              <>
                <span className={ui.dim}>at most</span>
                <Entry
                  className={classes.short}
                  aria-label={`${title}, at most`}
                  value={atMost}
                  unit={figure?.unit}
                  error={error !== undefined}
                  onType={(text) =>
                    onChange(limits.map((each) => (each.figure === name ? { ...each, atMost: text } : each)))
                  }
                />
              </>
            }
          />
        );
      })}
      {limits.length < MOST_LIMITS && (
        <FigureSelect
          label="Add a limit"
          figures={figures.filter(({ key }) => !limits.some(({ figure }) => figure === key))}
          error={errors.limits}
          onPick={(key) => onChange([...limits, limitOf(key)])}
        />
      )}
    </div>
  );
}
