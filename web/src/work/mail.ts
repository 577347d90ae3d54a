import { shell } from '../ui/shell.svelte';
import { sendAnswer } from './desk';
import { Mailer } from './mailer';

/** The tab's one mailer: it outlives the work view, so that an answer is sent wherever one goes. */
export const mailer = new Mailer(sendAnswer, sessionStorage, (outbox) => (shell.unsaved = outbox.length));
