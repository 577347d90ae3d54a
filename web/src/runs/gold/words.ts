// The known answer of a gold query in words.
import { readable } from '../../api/names';
import type { Gold } from '../../api/types';
import { t } from '../../language/language';
import { either } from '../../ui/format';

/** Return the right answer as one line: "pass"; "north, east or south"; "up, right, done at state 3". */
export function knownWords(known: Gold['known']): string {
  switch (known.kind) {
    case 'inspect_full':
    case 'inspect_lo':
      return known.verdict === 'pass' ? t('pass') : t('fail');
    case 'label_hi':
      return listed(known.subgoals);
    case 'label_full':
      return listed(known.actions);
    case 'label_lo': {
      const end = known.end === null ? t('not done') : t(`done at state ${known.end + 1}`);
      return known.actions.length === 0 ? end : `${listed(known.actions)}, ${end}`;
    }
  }
}

function listed(choices: readonly (readonly string[])[]): string {
  return choices.map((one) => either(one.map(readable))).join(', ');
}
