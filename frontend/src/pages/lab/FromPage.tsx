/** Where the lab's scenario comes from, if not from here, and the way there: another page, or the last visit. */

import { Anchor, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { Link } from "@tanstack/react-router";
import { titleOf } from "../../features/sweep/title";
import { BATCH, jobQuery } from "../../jobs/useJob";
import { parseSearch } from "../../lab/address";
import { useLabContext, useLab } from "../../lab/context";
import { useStore } from "../../lib/store";

export function FromPage() {
  const { lab, router, restored } = useLabContext();
  const { from, slug } = useStore(router);
  // An edit makes the scenario this visit's.
  const untouched = useLab((state) => state.history?.present === restored);
  if (slug !== null) return null;
  if (from !== undefined) return <Back from={from} />;
  if (!untouched) return null;
  return (
    <Text size="xs" role="status">
      Your last scenario.{" "}
      <Anchor component="button" size="xs" underline="always" onClick={lab.openPaper}>
        Open the paper’s scenario
      </Anchor>
    </Text>
  );
}

const NAMES: Readonly<Record<string, string>> = {
  b: "sweep",
  robustness: "study",
  tuner: "tuning",
  paper: "the paper",
};

function Back({ from }: { readonly from: string }) {
  const [path = "", search = ""] = from.split("?");
  const [, page = "", id = ""] = path.split("/");
  const sweep = useQuery({ ...jobQuery(BATCH, id), enabled: page === "b" }).data;
  const name = [NAMES[page], ...(sweep ? [`“${sweep.label ?? titleOf(sweep.fields)}”`] : [])].join(" ");
  return (
    <Text size="xs">
      <Anchor
        size="xs"
        underline="always"
        renderRoot={(props) => <Link to={path} search={parseSearch(search)} {...props} />}
      >
        From {name}
      </Anchor>
    </Text>
  );
}
