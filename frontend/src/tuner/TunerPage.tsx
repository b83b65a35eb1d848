import { PageHeader } from "../shell/PageHeader";
import shell from "../shell/shell.module.css";

export function TunerPage() {
  return <div className={shell.shell}><PageHeader /></div>;
}
