/** Generated from the server's OpenAPI document by `npm run types`. Do not edit. */

export interface paths {
    "/api/v1/assignments/{assignment}/answer": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Answer
         * @description Answer a query. One transaction stores and charges the answer; the reply comes when the answer is on disk.
         *
         *     If the query wanted as `next` cannot be leased, the answer stays accepted, and `next_problem` says why.
         *
         *     A token with scopes needs the scope answer. Needs the role admin or annotator. The assignment must be the caller's own.
         */
        post: operations["answer"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments/answers": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Answer Batch
         * @description Answer several queries, stored by one commit. Each answer has a receipt, or the problem why it does not count.
         *
         *     A token with scopes needs the scope answer. Needs the role admin or annotator.
         */
        post: operations["answerBatch"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments/{assignment}/retract": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Retract
         * @description Retract an answer that the learner has not used: refund it, and lease its query to the caller again.
         *
         *     A token with scopes needs the scope answer. Needs the role admin or annotator. The assignment must be the caller's own.
         */
        post: operations["retract"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * My Assignments
         * @description List the caller's live assignments, so that a reloaded tab can continue with them.
         *
         *     A token with scopes needs the scope answer. Needs the role admin or annotator.
         */
        get: operations["myAssignments"];
        put?: never;
        /**
         * Lease
         * @description Lease the next query; if there is none, wait for one.
         *
         *     A token with scopes needs the scope answer. Needs the role admin or annotator.
         */
        post: operations["lease"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments/batch": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Lease Batch
         * @description Lease the next queries, for a bot that answers several at once; wait for the first. The list may be empty.
         *
         *     A token with scopes needs the scope answer. Needs the role admin or annotator.
         */
        post: operations["leaseBatch"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments/leave": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Leave
         * @description Close a browser tab: release its assignments, except those in `keep`, and refuse its lease requests.
         *
         *     A token with scopes needs the scope answer. Needs the role admin or annotator.
         */
        post: operations["leave"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments/{assignment}/renew": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Renew
         * @description Renew the lease: it lasts its full length from now, but not longer than the server's cap.
         *
         *     A token with scopes needs the scope answer. Needs the role admin or annotator. The assignment must be the caller's own.
         */
        post: operations["renew"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments/{assignment}/release": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Release
         * @description Return the query to the queue without an answer. With `skip`, the caller does not get it again.
         *
         *     A token with scopes needs the scope answer. Needs the role admin or annotator. The assignment must be the caller's own.
         */
        post: operations["release"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/queries": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Queries
         * @description List a run's queries, newest first.
         *
         *     Needs the role admin or learner or viewer.
         */
        get: operations["listQueries"];
        put?: never;
        /**
         * Ask
         * @description Ask the expert: all of the queries or none. A query that was asked before is returned with its answer.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        post: operations["ask"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/queries/{query}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Query
         * @description Return a query; with `wait`, return as soon as it is answered or cancelled.
         *
         *     Needs the role admin or learner or viewer.
         */
        get: operations["getQuery"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/answers": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Answers
         * @description Return the queries answered after a cursor, in the order of their answers; with `wait`, wait for the first.
         *
         *     Needs the role admin or learner or viewer.
         */
        get: operations["listAnswers"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/queries/{query}/use": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Use Answer
         * @description Mark the answer as used. From then on it can no longer be retracted.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        post: operations["useAnswer"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Runs
         * @description List runs, newest first unless sorted otherwise.
         *
         *     Every role may call it.
         */
        get: operations["listRuns"];
        put?: never;
        /**
         * Create Run
         * @description Create a run: one learner's training with one algorithm, domain, seed and cost model.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner.
         */
        post: operations["createRun"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Run
         * @description Return a run with its account.
         *
         *     Every role may call it.
         */
        get: operations["getRun"];
        put?: never;
        post?: never;
        /**
         * Delete Run
         * @description Delete what a finished run contains, for good. Its costs and its ledger stay, and so do annotators' numbers.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        delete: operations["deleteRun"];
        options?: never;
        head?: never;
        /**
         * Patch Run
         * @description Rename, pause, resume or finish a run; set its budget or priority. Finishing a run cancels its open queries.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        patch: operations["patchRun"];
        trace?: never;
    };
    "/api/v1/runs/{run}/episodes": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Report Episodes
         * @description Report the results of episodes. Reporting the same result again changes nothing.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        post: operations["reportEpisodes"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/curves": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Curves
         * @description Return success and cumulative cost by episode.
         *
         *     Every role may call it.
         */
        get: operations["getCurves"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/costs": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Costs
         * @description Return the ledger's sums, by kind of query.
         *
         *     Every role may call it.
         */
        get: operations["getCosts"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/forecast": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Forecast
         * @description Forecast how many more units the run needs to reach a success rate.
         *
         *     Every role may call it.
         */
        get: operations["getForecast"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/query-rows": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Query Rows
         * @description List one page of a run's queries without their trajectories, newest first.
         *
         *     Needs the role admin or learner or viewer.
         */
        get: operations["listQueryRows"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/ledger": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Ledger
         * @description List one page of a run's charges and refunds, newest first, with the sums over all pages.
         *
         *     Needs the role admin or learner or viewer.
         */
        get: operations["listLedger"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/records": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Records
         * @description List one page of a run's records: its queries with their histories, its ledger, or its episodes.
         *
         *     Needs the role admin or learner or viewer.
         */
        get: operations["listRecords"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/queries/{query}/history": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get History
         * @description Return all assignments of a query, their answers, and what they cost.
         *
         *     Needs the role admin or learner or viewer.
         */
        get: operations["getHistory"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/stuck": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Stuck
         * @description List the queries of a run that are stuck, and why: nobody takes them, leases expire, or everybody skips them.
         *
         *     Needs the role admin or learner or viewer.
         */
        get: operations["listStuck"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/annotators": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List At Work
         * @description List the annotators at work, in one run or in all: those who asked for a query recently or hold one.
         *
         *     Every role may call it.
         */
        get: operations["listAtWork"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/outlook": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Outlook
         * @description Return what the learners do now and when they will ask, for annotators who wait; `run` is the first run.
         *
         *     Every role may call it.
         */
        get: operations["getOutlook"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/export": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Export Run
         * @description Download a run's curves, ledger or queries as CSV or JSON Lines.
         *
         *     Needs the role admin or learner or viewer.
         */
        get: operations["exportRun"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/events": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Stream Events
         * @description Stream the events of a run, starting after a cursor. For annotators, `data` is empty.
         *
         *     Every role may call it.
         */
        get: operations["streamEvents"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/events": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Stream Changes
         * @description Stream a message whenever any run has changed, at most one a second.
         *
         *     Every role may call it.
         */
        get: operations["streamChanges"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/frames": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        /**
         * Put Frames
         * @description Upload pictures of states: all of them or none. Pictures that were uploaded before do not change.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner.
         */
        put: operations["putFrames"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/frames/missing": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Missing Frames
         * @description Return the hashes of frames that are not stored yet.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner.
         */
        post: operations["missingFrames"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/frames/{frame}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Frame
         * @description Return a picture. The picture of a hash never changes.
         *
         *     Every role may call it.
         */
        get: operations["getFrame"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/users": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Users
         * @description List all users.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        get: operations["listUsers"];
        put?: never;
        /**
         * Create User
         * @description Create a user: a person or a program that may call the server.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        post: operations["createUser"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/users/{user}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get User
         * @description Return a user.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        get: operations["getUser"];
        put?: never;
        post?: never;
        /**
         * Erase User
         * @description Delete the personal data of a deactivated user, for good. Answers and their costs stay, without a name.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        delete: operations["eraseUser"];
        options?: never;
        head?: never;
        /**
         * Patch User
         * @description Change a user's role; deactivate or reactivate a user.
         *
         *     Deactivation revokes sessions, tokens and login links, and releases leases, all immediately. Answers stay.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        patch: operations["patchUser"];
        trace?: never;
    };
    "/api/v1/users/{user}/login-links": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Create Login Link
         * @description Create a one-time login code; the link is `<this server>/login#<code>`.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        post: operations["createLoginLink"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/users/{user}/tokens": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Tokens
         * @description List a user's API tokens, without their secrets.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        get: operations["listTokens"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/users/{user}/numbers": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Numbers
         * @description Return a user's performance: number of answers, speed, accuracy on gold queries.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        get: operations["getNumbers"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/numbers": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Numbers
         * @description Return the performance of every annotator who ever answered.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        get: operations["listNumbers"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tokens": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Create Token
         * @description Create an API token for the caller; an administrator may create one for any user. It is shown only once.
         *
         *     A token that is made with a token does not outlive it, and has no scope that it lacks.
         *
         *     A token with scopes needs the scope manage. Every role may call it. The token must be the caller's own; administrators may do it for every token.
         */
        post: operations["createToken"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tokens/{token}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Revoke Token
         * @description Revoke one of the caller's tokens; an administrator may revoke any. It takes effect immediately.
         *
         *     A token with scopes needs the scope manage. Every role may call it. The token must be the caller's own; administrators may do it for every token.
         */
        delete: operations["revokeToken"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/session": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Login
         * @description Exchange the one-time code of a login link for a session cookie.
         */
        post: operations["login"];
        /**
         * Logout
         * @description End the browser's session. API tokens stay valid.
         *
         *     Every role may call it.
         */
        delete: operations["logout"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/me": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Me
         * @description Return the caller and the totals of their answers. This call also renews a browser's session.
         *
         *     Every role may call it.
         */
        get: operations["me"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/me/numbers": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * My Numbers
         * @description Return the caller's performance: number of answers, speed, accuracy on gold queries, ten at a time.
         *
         *     Every role may call it.
         */
        get: operations["myNumbers"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/me/tokens": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * My Tokens
         * @description List the caller's API tokens, without their secrets.
         *
         *     Every role may call it.
         */
        get: operations["myTokens"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/me/sessions": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * My Sessions
         * @description List the caller's browser sessions.
         *
         *     Every role may call it.
         */
        get: operations["mySessions"];
        put?: never;
        post?: never;
        /**
         * Logout Everywhere
         * @description End all of the caller's browser sessions, including this one. API tokens stay valid.
         *
         *     A token with scopes needs the scope manage. Every role may call it.
         */
        delete: operations["logoutEverywhere"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/sign-in": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Sign In
         * @description Return at which OpenID provider people may sign in, if there is one. Login links always work.
         */
        get: operations["getSignIn"];
        put?: never;
        /**
         * Begin Sign In
         * @description Begin a sign-in: return the provider's address, and a cookie that lets this browser end the sign-in.
         */
        post: operations["beginSignIn"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/sign-in/reply": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * End Sign In
         * @description Exchange the provider's reply for a session cookie. The user gets the role that the provider says.
         */
        post: operations["endSignIn"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/gold": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Gold
         * @description List the run's gold queries, newest first, each with its number of answers and their agreement.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner.
         */
        get: operations["listGold"];
        put?: never;
        /**
         * Add Gold
         * @description Make queries gold: answered queries of this run, or other queries with known answers. All of them or none.
         *
         *     The run's `gold_rate` is the share of each annotator's queries that are gold. They look like the learner's queries.
         *     They are never in the run's ledger, and the learner never sees them.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        post: operations["addGold"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/gold/{item}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Retire Gold
         * @description Retire a gold query: no annotator gets it any more. Answers to it stay.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        delete: operations["retireGold"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/review": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Review
         * @description List one page of a run's answers to review, newest query first.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        get: operations["listReview"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/predictions": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        /**
         * Put Predictions
         * @description Send what the policies would answer now to queries whose answers were used. The review compares both.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        put: operations["putPredictions"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/agreement": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Agreement
         * @description Return how far annotators agree on the queries that two of them answered, by kind of query.
         *
         *     Needs the role admin or learner or viewer.
         */
        get: operations["getAgreement"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/queries/{query}/comments": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Comment
         * @description Comment on a query. Annotators do not see it.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        post: operations["comment"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/queries/{query}/send-back": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Send Back
         * @description Send an answer back that the learner has not used: refund it, and open its query again for every annotator.
         *
         *     Whoever gets the query next sees the comment, and the annotator who gave the answer finds it at `GET /me/returned`.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        post: operations["sendBack"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/me/returned": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * My Returned
         * @description List the caller's answers that a reviewer sent back, newest first, each with the comment.
         *
         *     Every role may call it.
         */
        get: operations["myReturned"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/practice": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Practice
         * @description Return the practice queries of a domain in the order to answer them.
         *
         *     Every role may call it.
         */
        get: operations["getPractice"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/practice/{query}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Mark Practice
         * @description Return which labels of an answer are right, and why.
         *
         *     Every role may call it.
         */
        post: operations["practice"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/practice": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        /**
         * Put Practice
         * @description Send practice queries of the run's domain. People get them unless the server has a file for this domain.
         *
         *     A token with scopes needs the scope learn. Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run.
         */
        put: operations["putPractice"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/webhooks": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Webhooks
         * @description List all webhooks.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        get: operations["listWebhooks"];
        put?: never;
        /**
         * Create Webhook
         * @description Create a webhook for an address that the operator has allowed. Its signing secret is shown only once.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        post: operations["createWebhook"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/webhooks/{webhook}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Webhook
         * @description Return a webhook.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        get: operations["getWebhook"];
        put?: never;
        post?: never;
        /**
         * Delete Webhook
         * @description Delete a webhook and its messages.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        delete: operations["deleteWebhook"];
        options?: never;
        head?: never;
        /**
         * Patch Webhook
         * @description Change a webhook, or turn it off or on. Turning it on tries its pending messages immediately.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        patch: operations["patchWebhook"];
        trace?: never;
    };
    "/api/v1/webhooks/{webhook}/ping": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Ping Webhook
         * @description Send a test message.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        post: operations["pingWebhook"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/webhooks/{webhook}/deliveries": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Deliveries
         * @description List one page of a webhook's messages, newest first. Messages that ended more than a week ago are deleted.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        get: operations["listDeliveries"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/webhooks/{webhook}/deliveries/{delivery}/redeliver": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Redeliver
         * @description Send a message again, with the same id and content.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        post: operations["redeliver"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/audit": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Audit
         * @description List one page of the audit log, newest first: who did what with access, and what was refused.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        get: operations["listAudit"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/audit/export": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Export Audit
         * @description Download the whole audit log, oldest rows first, with all hashes.
         *
         *     A token with scopes needs the scope manage. Needs the role admin.
         */
        get: operations["exportAudit"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/healthz": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Healthz
         * @description Report that the process is alive.
         */
        get: operations["healthz"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/readyz": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Readyz
         * @description Report that the database can be read and written, and that the server goes on. One check serves a second.
         */
        get: operations["readyz"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/metrics": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Metrics
         * @description Return metrics of the store and of this process in Prometheus' text format.
         *
         *     Needs the role admin or learner or viewer.
         */
        get: operations["metrics"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
}
export interface webhooks {
    message: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Message
         * @description Tell a receiver about a change. The headers are those of Standard Webhooks; any status from 200 to 299 accepts.
         *
         *     A receiver can get a message twice, with the same `webhook-id`.
         */
        post: operations["webhook"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
}
export interface components {
    schemas: {
        /**
         * Agreement
         * @description The agreement of the annotators of a run, sent by the server, and what its second answers cost.
         */
        Agreement: {
            /** By Kind */
            by_kind: components["schemas"]["AgreementOfKind"][];
            /**
             * Fewest
             * @description The number of queries answered twice from which on alpha is given.
             */
            fewest: number;
            /**
             * Waiting
             * @description The number of second answers that are still wanted.
             */
            waiting: number;
            /**
             * Units
             * @description What the second answers would cost at the run's prices; the run does not pay it.
             */
            units: number;
            /**
             * Active Seconds
             * @description The annotators' working time for them without idle time, in seconds.
             */
            active_seconds: number;
        };
        /**
         * AgreementOfKind
         * @description The agreement of first and second answers to one kind of query, sent by the server.
         */
        AgreementOfKind: {
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /**
             * Queries
             * @description The number of queries that two annotators answered.
             */
            queries: number;
            /**
             * Labels
             * @description The number of pairs of labels in these answers.
             */
            labels: number;
            /**
             * Share
             * @description The share of pairs whose labels are the same, 0 to 1; null without pairs.
             */
            share: number | null;
            /**
             * Alpha
             * @description Krippendorff's alpha of the labels as names; null with fewer queries than `fewest`, or if all labels are the same.
             */
            alpha: number | null;
        };
        /**
         * AnswerBatch
         * @description Answers that are stored together, sent by a bot. Sending them again returns the same receipts.
         */
        AnswerBatch: {
            /** Answers */
            answers: components["schemas"]["BatchedAnswer"][];
        };
        /**
         * AnswerNews
         * @description An answer that was accepted or retracted, without its content, which the REST API has.
         */
        AnswerNews: {
            /**
             * Event
             * @description The id of the event in the run's event stream; it grows with every change.
             */
            event: number;
            /**
             * Run
             * @description The id of the run.
             */
            run: string;
            /**
             * Query
             * @description The id of the query.
             */
            query: number;
            /**
             * Answer
             * @description The id of the answer.
             */
            answer: number;
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Units
             * @description The cost of the answer, charged or refunded, in units.
             */
            units: number;
        };
        /**
         * AnswerPage
         * @description Answered queries after a cursor, in the order of the answers, sent by the server.
         */
        AnswerPage: {
            /** Queries */
            queries: components["schemas"]["Query"][];
            /**
             * Cursor
             * @description The cursor for the next request.
             */
            cursor: number;
        };
        /**
         * AnswerPost
         * @description An answer, sent by an annotator. Sending it again returns the same receipt and costs nothing.
         */
        AnswerPost: {
            /**
             * Token
             * @description The token of the assignment.
             */
            token: string;
            /** Answer */
            answer: components["schemas"]["HierDemoAnswerInput"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
            /** @description Which query to lease in the same call; null for none. */
            next?: components["schemas"]["Lease"] | null;
        };
        /**
         * AnswerRecord
         * @description An answer as it was stored.
         */
        AnswerRecord: {
            /** Content */
            content: components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
            /**
             * Revision
             * @description How often the query had been retracted before this answer; null if the answer was late.
             */
            revision: number | null;
            /**
             * Units
             * @description The charged units; 0 if the answer was late.
             */
            units: number;
            /**
             * Seconds
             * @description The time from lease to answer, in seconds.
             */
            seconds: number;
            /**
             * Active Seconds
             * @description The annotator's working time without idle time, in seconds.
             */
            active_seconds: number;
            /**
             * At
             * @description When it was given, in seconds since the epoch.
             */
            at: number;
        };
        /**
         * AskHierDemo
         * @description HierDemo(s): carry out the task from state s, and return the hierarchical trajectory (or a flat one).
         */
        AskHierDemoInput: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion?: (components["schemas"]["HierDemoAnswerInput"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "hier_demo";
            /** @description s, the first state of the demonstration. */
            state: components["schemas"]["JsonValue"];
            /**
             * Flat
             * @description Whether to return only actions: one segment without a subgoal.
             * @default false
             */
            flat: boolean;
            /**
             * Max Segments
             * @description H_HI, the largest number of segments.
             */
            max_segments: number;
            /**
             * Max Actions
             * @description H_FULL, the largest number of actions in all segments.
             */
            max_actions: number;
        };
        /**
         * AskHierDemo
         * @description HierDemo(s): carry out the task from state s, and return the hierarchical trajectory (or a flat one).
         */
        AskHierDemo: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "hier_demo";
            /** @description s, the first state of the demonstration. */
            state: components["schemas"]["JsonValue"];
            /**
             * Flat
             * @description Whether to return only actions: one segment without a subgoal.
             * @default false
             */
            flat: boolean;
            /**
             * Max Segments
             * @description H_HI, the largest number of segments.
             */
            max_segments: number;
            /**
             * Max Actions
             * @description H_FULL, the largest number of actions in all segments.
             */
            max_actions: number;
        };
        /**
         * AskInspectFull
         * @description Inspect_FULL(tau_FULL): decide whether the episode accomplished the whole task.
         */
        AskInspectFullInput: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion?: (components["schemas"]["HierDemoAnswerInput"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_full";
            /**
             * Segments
             * @description The segments of the episode, in order.
             */
            segments: components["schemas"]["SegmentInput"][];
        };
        /**
         * AskInspectFull
         * @description Inspect_FULL(tau_FULL): decide whether the episode accomplished the whole task.
         */
        AskInspectFull: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_full";
            /**
             * Segments
             * @description The segments of the episode, in order.
             */
            segments: components["schemas"]["Segment"][];
        };
        /**
         * AskInspectLo
         * @description Inspect_LO(tau; g): decide whether this segment accomplished its subgoal.
         */
        AskInspectLoInput: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion?: (components["schemas"]["HierDemoAnswerInput"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_lo";
            /**
             * Segments
             * @description The segment to inspect.
             */
            segments: components["schemas"]["SegmentInput"][];
        };
        /**
         * AskInspectLo
         * @description Inspect_LO(tau; g): decide whether this segment accomplished its subgoal.
         */
        AskInspectLo: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_lo";
            /**
             * Segments
             * @description The segment to inspect.
             */
            segments: components["schemas"]["Segment"][];
        };
        /**
         * AskLabelFull
         * @description Label_FULL(tau_FULL): choose a good action for each state of the full trajectory.
         */
        AskLabelFullInput: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion?: (components["schemas"]["HierDemoAnswerInput"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_full";
            /**
             * Segments
             * @description The segments of the episode, in order.
             */
            segments: components["schemas"]["SegmentInput"][];
        };
        /**
         * AskLabelFull
         * @description Label_FULL(tau_FULL): choose a good action for each state of the full trajectory.
         */
        AskLabelFull: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_full";
            /**
             * Segments
             * @description The segments of the episode, in order.
             */
            segments: components["schemas"]["Segment"][];
        };
        /**
         * AskLabelHi
         * @description Label_HI(tau_HI): choose a good subgoal for the first state of each segment.
         */
        AskLabelHiInput: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion?: (components["schemas"]["HierDemoAnswerInput"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_hi";
            /**
             * Segments
             * @description The segments to label, in order.
             */
            segments: components["schemas"]["SegmentInput"][];
        };
        /**
         * AskLabelHi
         * @description Label_HI(tau_HI): choose a good subgoal for the first state of each segment.
         */
        AskLabelHi: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_hi";
            /**
             * Segments
             * @description The segments to label, in order.
             */
            segments: components["schemas"]["Segment"][];
        };
        /**
         * AskLabelLo
         * @description Label_LO(tau; g): choose a good action for each state of this segment, and mark where it should have ended.
         */
        AskLabelLoInput: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion?: (components["schemas"]["HierDemoAnswerInput"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_lo";
            /**
             * Segments
             * @description The segment to label.
             */
            segments: components["schemas"]["SegmentInput"][];
        };
        /**
         * AskLabelLo
         * @description Label_LO(tau; g): choose a good action for each state of this segment, and mark where it should have ended.
         */
        AskLabelLo: {
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The query in words, for people.
             */
            question: string;
            /** @description The environment instance, as a JSON view of the domain. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Earlier segments, which are shown but not part of the query.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choices in the form of an answer; they may be wrong.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_lo";
            /**
             * Segments
             * @description The segment to label.
             */
            segments: components["schemas"]["Segment"][];
        };
        /**
         * AskList
         * @description One or more queries of one run, sent by the learner.
         *
         *     Sending a query again with the same episode, ordinal and content changes nothing.
         */
        AskList: {
            /** Queries */
            queries: (components["schemas"]["AskHierDemoInput"] | components["schemas"]["AskInspectFullInput"] | components["schemas"]["AskLabelHiInput"] | components["schemas"]["AskInspectLoInput"] | components["schemas"]["AskLabelLoInput"] | components["schemas"]["AskLabelFullInput"])[];
            /**
             * Priority
             * @description Queries with a higher priority are handed out first.
             * @default 0
             */
            priority: number;
        };
        /**
         * Asked
         * @description The server's reply to `POST /runs/{id}/queries`: the queries in the same order, with answers if they have any.
         */
        Asked: {
            /** Queries */
            queries: components["schemas"]["Query"][];
        };
        /**
         * AssignedRun
         * @description The run of an assignment, as far as answering needs it; `GET /runs/{id}` has the rest.
         */
        AssignedRun: {
            /** Id */
            id: string;
            /** Name */
            name: string;
            vocabulary: components["schemas"]["Vocabulary"];
        };
        /**
         * Assignment
         * @description One query leased to one annotator, sent by the server. To answer, send `token` before the lease expires.
         */
        Assignment: {
            /** Id */
            id: number;
            /**
             * Token
             * @description The secret that proves the lease in every call about this assignment.
             */
            token: string;
            query: components["schemas"]["Query"];
            run: components["schemas"]["AssignedRun"];
            /** @description The price of the answer. */
            price: components["schemas"]["Price"];
            /**
             * Comments
             * @description The comments with which reviewers sent earlier answers to this query back, oldest first.
             */
            comments: components["schemas"]["Comment"][];
            /**
             * Leased At
             * @description When the lease began, in seconds since the epoch.
             */
            leased_at: number;
            /**
             * Expires At
             * @description When the lease expires without a renewal, in seconds since the epoch.
             */
            expires_at: number;
            /**
             * Lease Seconds
             * @description The length of a lease and of each renewal, in seconds.
             */
            lease_seconds: number;
        };
        /**
         * AssignmentList
         * @description Live assignments of the caller, oldest first, sent by the server. A reloaded web app continues with them.
         */
        AssignmentList: {
            /** Assignments */
            assignments: components["schemas"]["Assignment"][];
        };
        /**
         * AssignmentRecord
         * @description One assignment of a query: who held it, how it ended, and the answer that came of it.
         */
        AssignmentRecord: {
            /**
             * Annotator
             * @description The annotator's name or pseudonym.
             */
            annotator: string;
            /**
             * State
             * @enum {string}
             */
            state: "live" | "answered" | "skipped" | "released" | "expired" | "cancelled";
            /**
             * Deferring
             * @description Whether the annotator leaves queries to others for a while.
             */
            deferring: boolean;
            /**
             * Reason
             * @description The annotator's reason for skipping or releasing it.
             */
            reason: string | null;
            /**
             * Leased At
             * @description When the lease began, in seconds since the epoch.
             */
            leased_at: number;
            /**
             * Expires At
             * @description When the lease expired, in seconds since the epoch.
             */
            expires_at: number;
            /**
             * Ended At
             * @description When the assignment ended, in seconds since the epoch; null if it is live.
             */
            ended_at: number | null;
            answer: components["schemas"]["AnswerRecord"] | null;
        };
        /**
         * AtWork
         * @description An annotator who recently asked for work or holds a query, sent by the server.
         */
        AtWork: {
            /**
             * Annotator
             * @description The name of the user.
             */
            annotator: string;
            /**
             * Run
             * @description The id of the requested run; null for any run.
             */
            run: string | null;
            /**
             * Kinds
             * @description The requested kinds of queries; null for all kinds.
             */
            kinds: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full")[] | null;
            /**
             * Seen At
             * @description When they last asked for work or renewed a lease, in seconds since the epoch.
             */
            seen_at: number;
            /**
             * Holds
             * @description The queries that they hold, oldest first.
             */
            holds: components["schemas"]["Holding"][];
        };
        /**
         * AtWorkList
         * @description The annotators who are working, most recently seen first; sent by the server.
         */
        AtWorkList: {
            /** Annotators */
            annotators: components["schemas"]["AtWork"][];
        };
        /**
         * Attempt
         * @description A segment from whose outcome a subgoal's Q-function learns.
         */
        Attempt: {
            /** Subgoal */
            subgoal: string;
            /**
             * Reached
             * @description Whether the segment ended at the subgoal.
             */
            reached: boolean;
        };
        /**
         * AuditPage
         * @description One page of the audit log, newest first, sent by the server.
         */
        AuditPage: {
            /** Rows */
            rows: components["schemas"]["AuditRow"][];
            /**
             * Total
             * @description The number of rows on all pages.
             */
            total: number;
            /**
             * Newest
             * @description The number of the newest row on all pages.
             */
            newest: number | null;
            /**
             * Oldest
             * @description The number of the oldest row on all pages.
             */
            oldest: number | null;
            /**
             * Head
             * @description NUMBER:HASH of the newest row of all, whatever the filter. Noted elsewhere, `waypost check --audit-head` finds with it whether the end of the log was cut off.
             */
            head: string | null;
        };
        /**
         * AuditRow
         * @description One row of the audit log, sent by the server. The SHA-256 is of its other fields as canonical JSON.
         */
        AuditRow: {
            /**
             * Number
             * @description 1 for the first row, then one more for each row.
             */
            number: number;
            /**
             * At
             * @description When it happened, in UTC: 2026-01-31T12:00:00.000000Z.
             */
            at: string;
            /**
             * User
             * @description The id of the user who acted; null for all other actors.
             */
            user: number | null;
            /**
             * Actor
             * @description The name of the user who acted; `nobody` without a valid credential; `command line` for a command; `identity provider` for what a sign-in there changes.
             */
            actor: string;
            /**
             * Address
             * @description The address of the client as the server saw it; null for a command.
             */
            address: string | null;
            /**
             * Action
             * @enum {string}
             */
            action: "login" | "login.refused" | "logout" | "link.created" | "permission.refused" | "run.deleted" | "token.created" | "token.revoked" | "user.created" | "user.identified" | "user.role_changed" | "user.deactivated" | "user.reactivated" | "user.erased";
            /**
             * Object
             * @description The user, token or run that it is about: `user/7`; null if there is none.
             */
            object: string | null;
            /**
             * Details
             * @description More about the action; never a secret.
             */
            details: {
                [key: string]: components["schemas"]["JsonValue"];
            };
            /**
             * Previous
             * @description The hash of the row before; 64 zeros in the first row.
             */
            previous: string;
            /**
             * Hash
             * @description The SHA-256 of the other fields as JSON: keys sorted, no spaces, ASCII only.
             */
            hash: string;
        };
        /**
         * BatchReceipt
         * @description The server's reply to a batch of answers: what became of each, in the same order.
         */
        BatchReceipt: {
            /** Results */
            results: components["schemas"]["BatchResult"][];
        };
        /**
         * BatchResult
         * @description What became of one answer of a batch: it has a receipt, or a problem because of which it does not count.
         */
        BatchResult: {
            receipt: components["schemas"]["Receipt"] | null;
            problem: components["schemas"]["Problem"] | null;
        };
        /**
         * BatchedAnswer
         * @description One answer of a batch.
         */
        BatchedAnswer: {
            /**
             * Assignment
             * @description The id of the assignment.
             */
            assignment: number;
            /**
             * Token
             * @description The token of the assignment.
             */
            token: string;
            /** Answer */
            answer: components["schemas"]["HierDemoAnswerInput"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
        };
        /**
         * Box
         * @description A box in a picture. Its sides are shares of the picture's width and height, from the upper left corner.
         */
        Box: {
            /** Left */
            left: number;
            /** Top */
            top: number;
            /** Right */
            right: number;
            /** Bottom */
            bottom: number;
        };
        /**
         * Change
         * @description A server-sent event: something changed in some run.
         */
        Change: {
            /**
             * Newest
             * @description The id of the newest event of all runs.
             */
            newest: number;
        };
        /**
         * Comment
         * @description A reviewer's comment on a query, sent by the server.
         */
        Comment: {
            /** Id */
            id: number;
            /**
             * By
             * @description The name of the reviewer.
             */
            by: string;
            /**
             * At
             * @description When it was written, in seconds since the epoch.
             */
            at: number;
            /** Text */
            text: string;
            /**
             * Answer
             * @description The id of the answer that was sent back with it; null for a mere comment.
             */
            answer: number | null;
        };
        /**
         * CommentPost
         * @description A comment on a query, sent by a reviewer. Comments never change.
         */
        CommentPost: {
            /**
             * Text
             * @description The comment; not only spaces.
             */
            text: string;
        };
        /**
         * CostOfKind
         * @description The sums of the ledger for one kind of query.
         */
        CostOfKind: {
            /**
             * Queries
             * @description The number of charged answers, without refunded ones.
             */
            queries: number;
            /**
             * Units
             * @description The cost, in units.
             */
            units: number;
            /**
             * Lo Units
             * @description The part of `units` for LO labels: actions and terminations.
             */
            lo_units: number;
            /**
             * Seconds
             * @description The time from lease to answer, in seconds.
             */
            seconds: number;
            /**
             * Active Seconds
             * @description The annotators' working time without idle time, in seconds.
             */
            active_seconds: number;
        };
        /**
         * Costs
         * @description The sums of a run's ledger, sent by the server.
         */
        Costs: {
            /**
             * Total
             * @description The total cost, in units.
             */
            total: number;
            /**
             * Lo Total
             * @description The cost of LO labels (actions and terminations), in units.
             */
            lo_total: number;
            /**
             * Seconds
             * @description The annotators' time from lease to answer, in seconds.
             */
            seconds: number;
            /**
             * Active Seconds
             * @description The annotators' working time without idle time, in seconds.
             */
            active_seconds: number;
            /** By Kind */
            by_kind: {
                [key: string]: components["schemas"]["CostOfKind"];
            };
            /**
             * Reserved
             * @description The units reserved for unanswered queries.
             */
            reserved: number;
            /**
             * Budget
             * @description The highest total cost of the run, in units; null for no limit.
             */
            budget: number | null;
            /**
             * Tests
             * @description The number of test rollouts. A level counts as reached from the 100th on.
             */
            tests: number;
            /**
             * First At
             * @description By success level ("0.8", "0.9", "0.95", "0.99"): when it was first reached; null if it was not.
             */
            first_at: {
                [key: string]: components["schemas"]["Milestone"] | null;
            };
        };
        /**
         * Curves
         * @description The curves of a run as columns with one row per reported episode, sent by the server.
         *
         *     Sums are cumulative and include the episode of the row.
         */
        Curves: {
            /**
             * Episode
             * @description The number of the episode, from 0.
             */
            episode: number[];
            /**
             * Success Rate
             * @description The success rate over the trailing 100 test episodes (fewer at the start), 0 to 1.
             */
            success_rate: (number | null)[];
            /**
             * Test Success
             * @description Whether the test rollout succeeded; null if there was none.
             */
            test_success: (boolean | null)[];
            /**
             * Cost
             * @description The total cost, in units.
             */
            cost: number[];
            /**
             * Lo Cost
             * @description The cost of LO labels (actions and terminations), in units.
             */
            lo_cost: number[];
            /**
             * Seconds
             * @description The annotators' time from lease to answer, in seconds.
             */
            seconds: number[];
            /**
             * Active Seconds
             * @description The annotators' working time without idle time, in seconds.
             */
            active_seconds: number[];
            /**
             * Cost By Kind
             * @description The cost by kind of query, in units.
             */
            cost_by_kind: {
                [key: string]: number[];
            };
            /**
             * Hi Labels
             * @description The size of D_HI.
             */
            hi_labels: number[];
            /**
             * Lo Samples
             * @description The number of LO-level steps in training rollouts.
             */
            lo_samples: number[];
            /**
             * Learner Seconds
             * @description The learner's wall time, in seconds.
             */
            learner_seconds: number[];
            /**
             * Reward
             * @description The mean reward of the trailing 100 training rollouts (fewer at the start); null before the first.
             */
            reward: (number | null)[];
            /**
             * Reached
             * @description By subgoal that a Q-function learns, how many of the trailing 100 attempts reached it, 0 to 1. Attempts that were not made yet count as failed.
             */
            reached: {
                [key: string]: number[];
            };
        };
        /**
         * Delivery
         * @description One message to one webhook, sent by the server.
         */
        Delivery: {
            /** Id */
            id: number;
            /**
             * Message
             * @description The `webhook-id` that every attempt carries.
             */
            message: string;
            /**
             * Type
             * @description The topic, or `ping`.
             */
            type: string;
            /**
             * Run
             * @description The id of the run; null for a ping.
             */
            run: string | null;
            /**
             * State
             * @enum {string}
             */
            state: "pending" | "delivered" | "given_up";
            /**
             * Attempts
             * @description The number of attempts so far.
             */
            attempts: number;
            /**
             * Status
             * @description The HTTP status of the last attempt; null if there was no reply.
             */
            status: number | null;
            /**
             * Reason
             * @description Why the last attempt failed; null if it did not.
             */
            reason: string | null;
            /**
             * Created At
             * @description When the message was queued, in seconds since the epoch.
             */
            created_at: number;
            /**
             * Next At
             * @description When the next attempt is due, in seconds since the epoch.
             */
            next_at: number | null;
            /**
             * Ended At
             * @description When it was delivered or given up, in seconds since the epoch.
             */
            ended_at: number | null;
        };
        /**
         * DeliveryPage
         * @description One page of the deliveries of a webhook, newest first, sent by the server.
         */
        DeliveryPage: {
            /** Deliveries */
            deliveries: components["schemas"]["Delivery"][];
        };
        /**
         * DemoReplay
         * @description What an annotator saw of a demonstration, for those who look at it later. The learner does not use it.
         */
        DemoReplayInput: {
            /**
             * Frames
             * @description One uploaded picture per state; empty if the web app draws the states itself. Pictures are not part of the query's content: the same query with other pictures is the same query.
             */
            frames?: string[];
            /**
             * Landmarks
             * @description Where subgoals are in the pictures: boxes by subgoal, one entry per state, or one for all states; empty if that is not known. Landmarks are not part of the query's content.
             */
            landmarks?: {
                [key: string]: components["schemas"]["Box"];
            }[];
            /**
             * Action Landmarks
             * @description Where actions lead in the pictures: boxes by action, one entry per state, or one for all states; empty if that is not known. They are not part of the query's content either.
             */
            action_landmarks?: {
                [key: string]: components["schemas"]["Box"];
            }[];
            /**
             * States
             * @description One JSON view of the domain per state, from the start to the last action.
             */
            states: components["schemas"]["JsonValue"][];
        };
        /**
         * DemoReplay
         * @description What an annotator saw of a demonstration, for those who look at it later. The learner does not use it.
         */
        DemoReplay: {
            /**
             * Frames
             * @description One uploaded picture per state; empty if the web app draws the states itself. Pictures are not part of the query's content: the same query with other pictures is the same query.
             */
            frames: string[];
            /**
             * Landmarks
             * @description Where subgoals are in the pictures: boxes by subgoal, one entry per state, or one for all states; empty if that is not known. Landmarks are not part of the query's content.
             */
            landmarks: {
                [key: string]: components["schemas"]["Box"];
            }[];
            /**
             * Action Landmarks
             * @description Where actions lead in the pictures: boxes by action, one entry per state, or one for all states; empty if that is not known. They are not part of the query's content either.
             */
            action_landmarks: {
                [key: string]: components["schemas"]["Box"];
            }[];
            /**
             * States
             * @description One JSON view of the domain per state, from the start to the last action.
             */
            states: components["schemas"]["JsonValue"][];
        };
        /**
         * DemoSegment
         * @description One segment of a demonstration. The learner computes its states from the actions.
         */
        DemoSegment: {
            /**
             * Subgoal
             * @description The subgoal of the segment; null in a flat demonstration.
             */
            subgoal: string | null;
            /**
             * Actions
             * @description a_1 .. a_H.
             */
            actions: string[];
        };
        /**
         * Difference
         * @description A place where the learner's policies would answer otherwise than the annotator did, sent by the server.
         */
        Difference: {
            /**
             * Place
             * @description The number of the segment or the state in the query, from 0.
             */
            place: number;
            /**
             * Answer
             * @description The annotator's label; "(done)" and "(not done)" are the two of a segment's end, null is none.
             */
            answer: string | null;
            /**
             * Policy
             * @description The label of the policies, in the same words.
             */
            policy: string | null;
        };
        /**
         * EpisodeList
         * @description Results of episodes, in their order, sent by the learner.
         */
        EpisodeList: {
            /** Episodes */
            episodes: components["schemas"]["EpisodeResultInput"][];
        };
        /**
         * EpisodeRecord
         * @description The result of an episode.
         */
        EpisodeRecord: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            record: "episode";
            result: components["schemas"]["EpisodeResult"];
            /**
             * At
             * @description When it was reported, in seconds since the epoch.
             */
            at: number;
        };
        /**
         * EpisodeResult
         * @description The result of one episode, sent by the learner.
         *
         *     Sending it again changes nothing, if all fields except `seconds` are the same.
         */
        EpisodeResultInput: {
            /**
             * Episode
             * @description The number of the episode, from 0.
             */
            episode: number;
            /**
             * Warm Start
             * @description Whether the episode was a demonstration instead of a rollout.
             */
            warm_start: boolean;
            /**
             * Train Success
             * @description Whether the training rollout succeeded; null for a demonstration.
             */
            train_success: boolean | null;
            /**
             * Test Success
             * @description Whether the test rollout on an unseen instance succeeded; null if there was none.
             */
            test_success: boolean | null;
            /**
             * Train Steps
             * @description The learner's steps in the training rollout.
             */
            train_steps: number;
            /**
             * Test Steps
             * @description The learner's steps in the test rollout.
             */
            test_steps: number;
            /**
             * Reward
             * @description The sum of the environment's rewards in the training rollout.
             * @default 0
             */
            reward: number;
            /**
             * Attempts
             * @description The attempts at subgoals, where Q-functions learn them.
             */
            attempts?: components["schemas"]["Attempt"][];
            /**
             * Hi Labels
             * @description The size of D_HI after the episode.
             */
            hi_labels: number;
            /**
             * Lo Labels
             * @description The size of all D_g together (flat learner: of D) after the episode.
             */
            lo_labels: number;
            /**
             * Seconds
             * @description The learner's wall time for the episode, in seconds.
             */
            seconds: number;
        };
        /**
         * EpisodeResult
         * @description The result of one episode, sent by the learner.
         *
         *     Sending it again changes nothing, if all fields except `seconds` are the same.
         */
        EpisodeResult: {
            /**
             * Episode
             * @description The number of the episode, from 0.
             */
            episode: number;
            /**
             * Warm Start
             * @description Whether the episode was a demonstration instead of a rollout.
             */
            warm_start: boolean;
            /**
             * Train Success
             * @description Whether the training rollout succeeded; null for a demonstration.
             */
            train_success: boolean | null;
            /**
             * Test Success
             * @description Whether the test rollout on an unseen instance succeeded; null if there was none.
             */
            test_success: boolean | null;
            /**
             * Train Steps
             * @description The learner's steps in the training rollout.
             */
            train_steps: number;
            /**
             * Test Steps
             * @description The learner's steps in the test rollout.
             */
            test_steps: number;
            /**
             * Reward
             * @description The sum of the environment's rewards in the training rollout.
             * @default 0
             */
            reward: number;
            /**
             * Attempts
             * @description The attempts at subgoals, where Q-functions learn them.
             */
            attempts: components["schemas"]["Attempt"][];
            /**
             * Hi Labels
             * @description The size of D_HI after the episode.
             */
            hi_labels: number;
            /**
             * Lo Labels
             * @description The size of all D_g together (flat learner: of D) after the episode.
             */
            lo_labels: number;
            /**
             * Seconds
             * @description The learner's wall time for the episode, in seconds.
             */
            seconds: number;
        };
        /**
         * Event
         * @description One change of a run, a server-sent event.
         */
        Event: {
            /**
             * Id
             * @description The cursor: a client that reconnects continues after this id.
             */
            id: number;
            /**
             * Run
             * @description The id of the run.
             */
            run: string;
            /**
             * Event
             * @enum {string}
             */
            event: "asked" | "answered" | "retracted" | "used" | "cancelled" | "episode" | "run";
            /**
             * At
             * @description When it happened, in seconds since the epoch.
             */
            at: number;
            /** Data */
            data: {
                [key: string]: components["schemas"]["JsonValue"];
            };
        };
        /**
         * Exercise
         * @description A practice query with its correct answers and a reason for each label.
         */
        Exercise: {
            /** Ask */
            ask: components["schemas"]["AskHierDemoInput"] | components["schemas"]["AskInspectFullInput"] | components["schemas"]["AskLabelHiInput"] | components["schemas"]["AskInspectLoInput"] | components["schemas"]["AskLabelLoInput"] | components["schemas"]["AskLabelFullInput"];
            /**
             * Known
             * @description The correct answers.
             */
            known: components["schemas"]["KnownVerdict"] | components["schemas"]["KnownSubgoals"] | components["schemas"]["KnownSegment"] | components["schemas"]["KnownActions"];
            /**
             * Reasons
             * @description For each label, why the correct labels are correct.
             */
            reasons: ("accomplished" | "not_accomplished" | "shortest" | "no_way")[];
        };
        /**
         * Feedback
         * @description The server's reply to a practice answer: each label compared with the correct ones.
         */
        Feedback: {
            /** Marks */
            marks: components["schemas"]["Mark"][];
            /**
             * Reasons
             * @description For each label, why the correct labels are correct. `accomplished`, `not_accomplished`: the goal is, or is not, accomplished in this state. `shortest`: they are on a shortest path to it. `no_way`: nothing leads to it from this state. The goal is the segment's subgoal in a Label_LO or an Inspect_LO, else the task.
             */
            reasons: ("accomplished" | "not_accomplished" | "shortest" | "no_way")[];
            /**
             * Is Right
             * @description Whether all labels are correct.
             */
            is_right: boolean;
        };
        /**
         * Forecast
         * @description When a run will reach a success rate over 100 test episodes, sent by the server.
         *
         *     Exactly one of `reached`, `too_early` and `more_units` is set.
         */
        Forecast: {
            /**
             * Target
             * @description The success rate.
             * @enum {string}
             */
            target: "0.8" | "0.9" | "0.95" | "0.99";
            /** @description When the run reached the target; null if it has not yet. */
            reached: components["schemas"]["Milestone"] | null;
            /**
             * Too Early
             * @description Why there is no forecast yet, as a sentence; null if there is one.
             */
            too_early: string | null;
            /** @description How many more units the run needs. */
            more_units: components["schemas"]["ForecastRange"] | null;
            /** @description The annotators' working time for these units, at the pace of the last answers by people; null if there were none. */
            more_seconds: components["schemas"]["ForecastRange"] | null;
            /**
             * Missed
             * @description The share of futures in which the run does not reach the target, 0 to 1.
             */
            missed: number | null;
            /**
             * Same Configuration
             * @description The number of finished runs used that differ only by their seed.
             */
            same_configuration: number;
            /**
             * Other Configurations
             * @description The number of other finished runs used, of the domain and algorithm.
             */
            other_configurations: number;
        };
        /**
         * ForecastRange
         * @description A forecast amount: the median of all possible futures, and the range that holds the middle 80 % of them.
         *
         *     Null: so many futures do not reach the target that the amount has no end.
         */
        ForecastRange: {
            /**
             * Low
             * @description In a tenth of the futures it is less.
             */
            low: number | null;
            /**
             * Median
             * @description In half of the futures it is less.
             */
            median: number | null;
            /**
             * High
             * @description In a tenth of the futures it is more.
             */
            high: number | null;
        };
        /**
         * Frame
         * @description A picture as a PNG file, identified by its hash.
         */
        Frame: {
            /**
             * Hash
             * @description The SHA-256 of a PNG file, in hexadecimal.
             */
            hash: string;
            /**
             * Png
             * @description The PNG file in base64.
             */
            png: string;
        };
        /**
         * FrameHashes
         * @description Hashes of frames, sent by a learner to ask which frames are missing, and by the server as the reply.
         */
        FrameHashes: {
            /** Hashes */
            hashes: string[];
        };
        /**
         * FrameUpload
         * @description Frames that a learner uploads. Uploading a frame again changes nothing.
         */
        FrameUpload: {
            /** Frames */
            frames: components["schemas"]["Frame"][];
        };
        /**
         * Gold
         * @description A gold query with its results so far, sent by the server.
         */
        Gold: {
            /** Id */
            id: number;
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /**
             * Question
             * @description The query in words.
             */
            question: string;
            /**
             * Known
             * @description The correct answers.
             */
            known: components["schemas"]["KnownVerdict"] | components["schemas"]["KnownSubgoals"] | components["schemas"]["KnownSegment"] | components["schemas"]["KnownActions"];
            /**
             * Query
             * @description The id of the answered query it was made from; null if there is none.
             */
            query: number | null;
            /**
             * Author
             * @description The name of the user who answered that query; they never get it as gold.
             */
            author: string | null;
            /**
             * Answers
             * @description How often it was answered.
             */
            answers: number;
            /**
             * Agreement
             * @description The share of correct labels in all answers, 0 to 1; null if none.
             */
            agreement: number | null;
            /**
             * Created At
             * @description When it became gold, in seconds since the epoch.
             */
            created_at: number;
        };
        /**
         * GoldList
         * @description The gold queries of a run, newest first, sent by the server.
         */
        GoldList: {
            /** Gold */
            gold: components["schemas"]["Gold"][];
        };
        /**
         * GoldPost
         * @description New gold queries of a run, sent by a learner or an administrator. Existing gold queries do not change.
         */
        GoldPost: {
            /**
             * Answered
             * @description Ids of answered queries of this run. Each answer becomes the only correct one.
             */
            answered?: number[];
            /**
             * Known
             * @description Queries together with their correct answers.
             */
            known?: components["schemas"]["KnownAsk"][];
        };
        /**
         * Health
         * @description The server's reply when it is alive or ready.
         */
        Health: {
            /**
             * Status
             * @constant
             */
            status: "ok";
            /**
             * Version
             * @description The version of Waypost.
             */
            version: string;
        };
        /**
         * HierDemoAnswer
         * @description The expert's own trajectory: segments that each end where the subgoal is reached, or one flat segment.
         */
        HierDemoAnswerInput: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "hier_demo";
            /**
             * Segments
             * @description The segments in order.
             */
            segments: components["schemas"]["DemoSegment"][];
            /** @description What the annotator saw, if the web app cannot compute it from the actions. */
            replay?: components["schemas"]["DemoReplayInput"] | null;
        };
        /**
         * HierDemoAnswer
         * @description The expert's own trajectory: segments that each end where the subgoal is reached, or one flat segment.
         */
        HierDemoAnswer: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "hier_demo";
            /**
             * Segments
             * @description The segments in order.
             */
            segments: components["schemas"]["DemoSegment"][];
            /** @description What the annotator saw, if the web app cannot compute it from the actions. */
            replay: components["schemas"]["DemoReplay"] | null;
        };
        /**
         * Holding
         * @description A query that an annotator holds now, sent by the server.
         */
        Holding: {
            /**
             * Query
             * @description The id of the query.
             */
            query: number;
            /**
             * Run
             * @description The id of the run.
             */
            run: string;
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Leased At
             * @description When the lease began, in seconds since the epoch.
             */
            leased_at: number;
        };
        /**
         * InspectAnswer
         * @description Pass or Fail, the answer to Inspect_FULL and Inspect_LO.
         */
        InspectAnswer: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_full" | "inspect_lo";
            /**
             * Verdict
             * @description Whether the task (the subgoal) was accomplished.
             * @enum {string}
             */
            verdict: "pass" | "fail";
        };
        JsonValue: unknown;
        /**
         * KnownActions
         * @description The correct actions of a Label_FULL.
         */
        KnownActions: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_full";
            /**
             * Actions
             * @description For each state of the full trajectory, all correct actions.
             */
            actions: string[][];
        };
        /**
         * KnownAsk
         * @description A query with its correct answers; a label can have several correct values.
         */
        KnownAsk: {
            /** Ask */
            ask: components["schemas"]["AskHierDemoInput"] | components["schemas"]["AskInspectFullInput"] | components["schemas"]["AskLabelHiInput"] | components["schemas"]["AskInspectLoInput"] | components["schemas"]["AskLabelLoInput"] | components["schemas"]["AskLabelFullInput"];
            /**
             * Known
             * @description The correct answers.
             */
            known: components["schemas"]["KnownVerdict"] | components["schemas"]["KnownSubgoals"] | components["schemas"]["KnownSegment"] | components["schemas"]["KnownActions"];
        };
        /**
         * KnownSegment
         * @description The correct actions and the correct end of a Label_LO.
         */
        KnownSegment: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_lo";
            /**
             * Actions
             * @description For each state before the segment should end, all correct actions.
             */
            actions: string[][];
            /**
             * End
             * @description The number of the state where the segment should end, from 0; null if in none.
             */
            end: number | null;
        };
        /**
         * KnownSubgoals
         * @description The correct subgoals of a Label_HI.
         */
        KnownSubgoals: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_hi";
            /**
             * Subgoals
             * @description For each segment, all correct subgoals.
             */
            subgoals: string[][];
        };
        /**
         * KnownVerdict
         * @description The correct verdict of an inspection.
         */
        KnownVerdict: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_full" | "inspect_lo";
            /**
             * Verdict
             * @enum {string}
             */
            verdict: "pass" | "fail";
        };
        /**
         * LabelFullAnswer
         * @description a*_1 .. a*_H: a good action for each state of the full trajectory.
         */
        LabelFullAnswer: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_full";
            /**
             * Actions
             * @description The actions of all segments, joined.
             */
            actions: string[];
        };
        /**
         * LabelHiAnswer
         * @description g*_1 .. g*_n: a good subgoal for each segment of the query.
         */
        LabelHiAnswer: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_hi";
            /**
             * Subgoals
             * @description One good subgoal per segment.
             */
            subgoals: string[];
        };
        /**
         * LabelLoAnswer
         * @description a*_1 .. a*_H and omega*_1 .. omega*_{H+1} of one segment with H actions.
         *
         *     The learner uses the labels up to the first true termination. From the state of that termination on, an action may
         *     be null, because no action toward the subgoal is good after the subgoal is reached.
         */
        LabelLoAnswer: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_lo";
            /**
             * Actions
             * @description A good action for each state but the last.
             */
            actions: (string | null)[];
            /**
             * Terminations
             * @description For each state, whether the segment should end.
             */
            terminations: boolean[];
        };
        /**
         * Lease
         * @description A request for the next query, sent by an annotator.
         */
        Lease: {
            /**
             * Wait
             * @description The longest time to wait for a query, in seconds.
             * @default 0
             */
            wait: number;
            /**
             * Kinds
             * @description Only queries of these kinds; null for all kinds.
             */
            kinds?: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full")[] | null;
            /**
             * Run
             * @description Only queries of the run with this id; null for all runs.
             */
            run?: string | null;
            /**
             * Defer
             * @description How long to leave new queries to other working annotators who take their kind, in seconds. Only bots that help people need this.
             * @default 0
             */
            defer: number;
            /**
             * Ahead
             * @description Whether the query is for later, because the annotator holds another one. It is leased only if enough queries remain for all other working annotators.
             * @default false
             */
            ahead: boolean;
            /**
             * Tab
             * @description The browser tab that asks; when it closes, `leave` releases its assignments.
             */
            tab?: string | null;
        };
        /**
         * LeaseBatch
         * @description A request for several queries at once, sent by a bot.
         */
        LeaseBatch: {
            /**
             * Count
             * @description The most queries to lease.
             */
            count: number;
            /**
             * Wait
             * @description The longest time to wait for a query, in seconds.
             * @default 0
             */
            wait: number;
            /**
             * Kinds
             * @description Only queries of these kinds; null for all kinds.
             */
            kinds?: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full")[] | null;
            /**
             * Run
             * @description Only queries of the run with this id; null for all runs.
             */
            run?: string | null;
            /**
             * Defer
             * @description How long to leave new queries to other working annotators who take their kind, in seconds.
             * @default 0
             */
            defer: number;
        };
        /**
         * Leave
         * @description Sent by a browser tab when it closes: its assignments are released, and it gets no new leases.
         */
        Leave: {
            /**
             * Tab
             * @description The name of a browser tab, chosen by the tab.
             */
            tab: string;
            /**
             * Keep
             * @description The ids of assignments to keep, because their answers are still being sent.
             */
            keep: number[];
        };
        /**
         * LedgerEntry
         * @description One entry of the ledger, sent by the server: a charge, or a refund with negative amounts.
         */
        LedgerEntry: {
            /** Id */
            id: number;
            /**
             * At
             * @description When it was booked, in seconds since the epoch.
             */
            at: number;
            /**
             * Entry
             * @enum {string}
             */
            entry: "charge" | "refund";
            /**
             * Kind
             * @description The kind of the query.
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /**
             * Query
             * @description The id of the query.
             */
            query: number;
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Annotator
             * @description The name of the user who answered.
             */
            annotator: string;
            /**
             * Units
             * @description The cost of the answer, in units.
             */
            units: number;
            /**
             * Lo Units
             * @description The part of `units` for LO labels: actions and terminations.
             */
            lo_units: number;
            /**
             * Seconds
             * @description The time from lease to answer, in seconds.
             */
            seconds: number;
            /**
             * Balance
             * @description The units that the run had spent after this entry.
             */
            balance: number;
        };
        /**
         * LedgerPage
         * @description One page of a run's ledger, newest first, with the sums over all pages; sent by the server.
         */
        LedgerPage: {
            /** Entries */
            entries: components["schemas"]["LedgerEntry"][];
            /**
             * Total
             * @description The number of entries on all pages.
             */
            total: number;
            /**
             * Newest
             * @description The id of the newest entry on all pages.
             */
            newest: number | null;
            /**
             * Oldest
             * @description The id of the oldest entry on all pages.
             */
            oldest: number | null;
            /**
             * Units
             * @description The sum of `units` on all pages.
             */
            units: number;
            /**
             * Lo Units
             * @description The sum of `lo_units` on all pages.
             */
            lo_units: number;
            /**
             * Seconds
             * @description The sum of `seconds` on all pages.
             */
            seconds: number;
            /**
             * Spent
             * @description The units that the run has spent; equal to `units` if there is no filter.
             */
            spent: number;
        };
        /**
         * LedgerRecord
         * @description One entry of the ledger: a charge, or a refund with negative amounts.
         */
        LedgerRecord: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            record: "ledger";
            /**
             * Entry
             * @enum {string}
             */
            entry: "charge" | "refund";
            /**
             * Kind
             * @description The kind of the query.
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Revision
             * @description The revision of the answer that was charged or refunded.
             */
            revision: number;
            /**
             * Units
             * @description The cost of the answer, in units.
             */
            units: number;
            /**
             * Lo Units
             * @description The part of `units` for LO labels: actions and terminations.
             */
            lo_units: number;
            /**
             * Seconds
             * @description The time from lease to answer, in seconds.
             */
            seconds: number;
            /**
             * Active Seconds
             * @description The working time without idle time, in seconds.
             */
            active_seconds: number;
            /**
             * At
             * @description When it was booked, in seconds since the epoch.
             */
            at: number;
        };
        /**
         * Login
         * @description The one-time code of a login link, sent by a browser.
         */
        Login: {
            /** Code */
            code: string;
        };
        /**
         * LoginLink
         * @description The code of a new one-time login link, sent by the server only once.
         */
        LoginLink: {
            /** Code */
            code: string;
            /**
             * Expires At
             * @description When the link expires, in seconds since the epoch.
             */
            expires_at: number;
        };
        /**
         * LoginLinkCreate
         * @description A request for a login link, sent by an administrator.
         */
        LoginLinkCreate: {
            /**
             * Seconds
             * @description How long the link is valid, in seconds; null for the server's default.
             */
            seconds?: number | null;
        };
        /**
         * Mark
         * @description One label of an answer, compared with the correct labels; sent by the server.
         */
        Mark: {
            /**
             * Place
             * @description The number of the label, from 0; for a Label_LO, the number of the state.
             */
            place: number;
            /**
             * Given
             * @description The label in the answer. "(done)" and "(not done)" are the two labels of a segment's end.
             */
            given: string | null;
            /**
             * Right
             * @description All correct labels in this place.
             */
            right: string[];
            /**
             * Is Right
             * @description Whether the given label is correct.
             */
            is_right: boolean;
        };
        /**
         * Me
         * @description The calling user, sent by the server.
         */
        Me: {
            /** Id */
            id: number;
            /** Name */
            name: string;
            /**
             * Role
             * @enum {string}
             */
            role: "admin" | "learner" | "annotator" | "viewer";
            /**
             * Answers
             * @description The number of the user's answers that count.
             */
            answers: number;
            /**
             * Answers Today
             * @description The number of these answers since midnight UTC.
             */
            answers_today: number;
            /**
             * Active Seconds Today
             * @description The user's working time for the answers since midnight UTC, without idle time, in seconds.
             */
            active_seconds_today: number;
            /**
             * Median Seconds
             * @description The median working time of the last 1,000 of these answers, without idle time, in seconds.
             */
            median_seconds: number | null;
            /**
             * Units
             * @description The cost of these answers in all runs, in units.
             */
            units: number;
            /**
             * Held
             * @description The number of queries that the user holds, in every browser and program.
             */
            held: number;
            /**
             * Held Seconds
             * @description In how many seconds the first of these leases ends, unless it is renewed; null if there is none.
             */
            held_seconds: number | null;
            /**
             * Held By Others
             * @description The number of queries that other users hold.
             */
            held_by_others: number;
        };
        /**
         * Milestone
         * @description The first time that the success rate over 100 test episodes reached a level.
         */
        Milestone: {
            /**
             * Episode
             * @description The number of the episode, from 0.
             */
            episode: number;
            /**
             * Cost
             * @description The total cost up to and including this episode, in units.
             */
            cost: number;
        };
        /**
         * NewToken
         * @description A new API token, sent by the server only once. The server stores only its hash.
         */
        NewToken: {
            /** Id */
            id: number;
            /** Token */
            token: string;
        };
        /**
         * NewWebhook
         * @description A new webhook and its signing secret, sent by the server only once.
         */
        NewWebhook: {
            webhook: components["schemas"]["Webhook"];
            /**
             * Secret
             * @description The key of the signatures, in the format of Standard Webhooks: `whsec_...`.
             */
            secret: string;
        };
        /**
         * Numbers
         * @description Statistics of an annotator over all runs, sent by the server. Days are UTC days.
         */
        Numbers: {
            /**
             * User
             * @description The id of the user.
             */
            user: number;
            /**
             * Name
             * @description The name of the user.
             */
            name: string;
            total: components["schemas"]["Tally"];
            today: components["schemas"]["Tally"];
            /** @description Today and the six days before. */
            week: components["schemas"]["Tally"];
            /**
             * Gold
             * @description The number of answered gold queries. In the caller's own numbers, it grows in steps of ten.
             */
            gold: number;
            /**
             * Agreement
             * @description The share of correct labels in first answers to gold queries, 0 to 1; null if there are none.
             */
            agreement: number | null;
            /**
             * By Kind
             * @description The statistics for each kind of query that they answered.
             */
            by_kind: components["schemas"]["NumbersOfKind"][];
        };
        /**
         * NumbersList
         * @description The statistics of all annotators who ever answered, by name, sent by the server.
         */
        NumbersList: {
            /** Annotators */
            annotators: components["schemas"]["Numbers"][];
        };
        /**
         * NumbersOfKind
         * @description Statistics of an annotator's answers to one kind of query.
         */
        NumbersOfKind: {
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            total: components["schemas"]["Tally"];
            /**
             * Median Seconds
             * @description The median time from lease to answer, in seconds.
             */
            median_seconds: number;
            /**
             * Gold
             * @description The number of answers to gold queries.
             */
            gold: number;
            /**
             * Gold Right
             * @description The number of answers to gold queries with only correct labels.
             */
            gold_right: number;
            /**
             * Agreement
             * @description The share of correct labels in answers to gold queries, 0 to 1; null if there are none.
             */
            agreement: number | null;
        };
        /**
         * Outlook
         * @description What an annotator without a query can expect, sent by the server.
         */
        Outlook: {
            /**
             * Open
             * @description The number of unanswered queries of all running runs, rounded up to tens; 1,000 for more.
             */
            open: number;
            /**
             * Runs
             * @description The newest runs, at most six: running ones first, then paused ones, then finished ones.
             */
            runs: components["schemas"]["RunOutlook"][];
        };
        /**
         * PastAnswer
         * @description An answer that was given at some time, sent by the server. Answers never change.
         */
        PastAnswer: {
            /** Id */
            id: number;
            /** Content */
            content: components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
            /**
             * At
             * @description When it was given, in seconds since the epoch.
             */
            at: number;
            /**
             * Units
             * @description The charged units; 0 if the answer was late.
             */
            units: number;
            /**
             * Seconds
             * @description The time from lease to answer, in seconds.
             */
            seconds: number;
            /**
             * Fate
             * @description Whether the answer counts, was retracted, or came after the end of the lease.
             * @enum {string}
             */
            fate: "counts" | "retracted" | "late";
        };
        /**
         * PastAssignment
         * @description One assignment of a query and its end, sent by the server.
         */
        PastAssignment: {
            /** Id */
            id: number;
            /**
             * Annotator
             * @description The name of the user.
             */
            annotator: string;
            /**
             * State
             * @enum {string}
             */
            state: "live" | "answered" | "skipped" | "released" | "expired" | "cancelled";
            /**
             * Reason
             * @description The annotator's reason for skipping or releasing it.
             */
            reason: string | null;
            /**
             * Leased At
             * @description When the lease began, in seconds since the epoch.
             */
            leased_at: number;
            /**
             * Expires At
             * @description When the lease expires or expired, in seconds since the epoch.
             */
            expires_at: number;
            /**
             * Ended At
             * @description When the assignment ended, in seconds since the epoch; null if live.
             */
            ended_at: number | null;
            answer: components["schemas"]["PastAnswer"] | null;
        };
        /**
         * PingNews
         * @description The content of a test message.
         */
        PingNews: {
            /**
             * Webhook
             * @description The id of the webhook.
             */
            webhook: number;
        };
        /**
         * Practice
         * @description The practice queries of a domain in their order, sent by the server. Practice stores and costs nothing.
         */
        Practice: {
            vocabulary: components["schemas"]["Vocabulary"];
            /** Queries */
            queries: components["schemas"]["PracticeQuery"][];
            /**
             * Examples
             * @description The last query of each kind, for the kinds that have several queries.
             */
            examples: components["schemas"]["WorkedExample"][];
            /**
             * Demonstrations
             * @description At most one for each way in which demonstrations are asked for.
             */
            demonstrations: components["schemas"]["WorkedDemonstration"][];
            /**
             * Domains
             * @description All domains that can be practiced on this server.
             */
            domains: string[];
        };
        /**
         * PracticeAnswer
         * @description An answer to a practice query, sent by an annotator.
         */
        PracticeAnswer: {
            /** Answer */
            answer: components["schemas"]["HierDemoAnswerInput"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
        };
        /**
         * PracticePut
         * @description Practice queries of a run's domain, sent by its learner. Their pictures are uploaded before.
         */
        PracticePut: {
            /** Exercises */
            exercises: components["schemas"]["Exercise"][];
            /**
             * Demonstrations
             * @description At most one for each way in which demonstrations are asked for.
             */
            demonstrations: components["schemas"]["WorkedDemonstrationInput"][];
        };
        /**
         * PracticeQuery
         * @description A practice query, sent by the server.
         */
        PracticeQuery: {
            /** Id */
            id: number;
            /** Ask */
            ask: components["schemas"]["AskHierDemo"] | components["schemas"]["AskInspectFull"] | components["schemas"]["AskLabelHi"] | components["schemas"]["AskInspectLo"] | components["schemas"]["AskLabelLo"] | components["schemas"]["AskLabelFull"];
        };
        /**
         * Predicted
         * @description What the learner's policies would answer to a query, as the learner sent it last; sent by the server.
         */
        Predicted: {
            /**
             * Episode
             * @description The last episode from which the policies had learned.
             */
            episode: number;
            /** Answer */
            answer: components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
            /**
             * Differences
             * @description Where it differs from the annotator's answer.
             */
            differences: components["schemas"]["Difference"][];
        };
        /**
         * Prediction
         * @description What the current policies would answer to a query whose answer the learner has used, sent by the learner.
         */
        Prediction: {
            /**
             * Query
             * @description The id of the query.
             */
            query: number;
            /**
             * Answer
             * @description Of the query's kind, which is one of the kinds that ask for labels.
             */
            answer: components["schemas"]["HierDemoAnswerInput"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
        };
        /**
         * Predictions
         * @description What the policies of one moment would answer, sent by the learner.
         */
        Predictions: {
            /**
             * Episode
             * @description The last episode from which the policies learned.
             */
            episode: number;
            /**
             * Predictions
             * @description At most one per query.
             */
            predictions: components["schemas"]["Prediction"][];
        };
        /**
         * Price
         * @description The price of an answer, sent by the server: `fixed` + `per_action` x actions + `per_segment` x segments.
         *
         *     Only the price of a demonstration depends on the answer. All other kinds have a fixed price.
         */
        Price: {
            /**
             * Fixed
             * @description The fixed part, in units.
             */
            fixed: number;
            /**
             * Per Action
             * @description The price of each action of a demonstration, in units.
             */
            per_action: number;
            /**
             * Per Segment
             * @description The price of each segment of a demonstration, in units.
             */
            per_segment: number;
        };
        /**
         * Prices
         * @description The prices of a run, in units with up to six decimals.
         *
         *     The defaults are the paper's: a Label costs the length of what it labels, an Inspect costs 1.
         */
        PricesInput: {
            /**
             * Subgoal
             * @description The price of one HI label (a subgoal at a state), in units.
             * @default 1
             */
            subgoal: number;
            /**
             * Action
             * @description The price of one LO label (an action at a state), in units.
             * @default 1
             */
            action: number;
            /**
             * Termination
             * @description The price of the termination labels of one segment, in units.
             * @default 1
             */
            termination: number;
            /**
             * Inspect Full
             * @description The price of one Inspect_FULL, in units.
             * @default 1
             */
            inspect_full: number;
            /**
             * Inspect Lo
             * @description The price of one Inspect_LO, in units.
             * @default 1
             */
            inspect_lo: number;
        };
        /**
         * Prices
         * @description The prices of a run, in units with up to six decimals.
         *
         *     The defaults are the paper's: a Label costs the length of what it labels, an Inspect costs 1.
         */
        Prices: {
            /**
             * Subgoal
             * @description The price of one HI label (a subgoal at a state), in units.
             * @default 1
             */
            subgoal: number;
            /**
             * Action
             * @description The price of one LO label (an action at a state), in units.
             * @default 1
             */
            action: number;
            /**
             * Termination
             * @description The price of the termination labels of one segment, in units.
             * @default 1
             */
            termination: number;
            /**
             * Inspect Full
             * @description The price of one Inspect_FULL, in units.
             * @default 1
             */
            inspect_full: number;
            /**
             * Inspect Lo
             * @description The price of one Inspect_LO, in units.
             * @default 1
             */
            inspect_lo: number;
        };
        /**
         * Problem
         * @description The server's reply to every request that it refuses, in the format of RFC 9457.
         */
        Problem: {
            /**
             * Type
             * @description The stable name of the problem: `/problems/<name>`.
             */
            type: string;
            /**
             * Title
             * @description The problem in a few words, the same for every occurrence.
             */
            title: string;
            /**
             * Status
             * @description The HTTP status code.
             */
            status: number;
            /**
             * Detail
             * @description What was wrong with this request, and what to do.
             */
            detail: string;
            /**
             * Instance
             * @description The path of the request.
             */
            instance?: string | null;
            /**
             * Errors
             * @description For status 422: each invalid field.
             */
            errors?: {
                [key: string]: components["schemas"]["JsonValue"];
            }[] | null;
            /**
             * Roles
             * @description For `forbidden`: the roles that may do this.
             */
            roles?: ("admin" | "learner" | "annotator" | "viewer")[] | null;
            /**
             * Owner
             * @description For `forbidden`: the name of the run's owner, who may.
             */
            owner?: string | null;
            /**
             * Spent
             * @description For `budget-too-low`: the units spent on answered queries.
             */
            spent?: number | null;
            /**
             * Reserved
             * @description For `budget-too-low`: the units reserved for unanswered queries.
             */
            reserved?: number | null;
            /**
             * Request Id
             * @description For status 5xx: the id of the request in the server's log.
             */
            request_id?: string | null;
        };
        /**
         * Query
         * @description A query with its state and its answer, sent by the server.
         */
        Query: {
            /** Id */
            id: number;
            /**
             * Run
             * @description The id of the run.
             */
            run: string;
            /**
             * State
             * @enum {string}
             */
            state: "open" | "leased" | "answered" | "cancelled";
            /**
             * Priority
             * @description Queries with a higher priority are handed out first.
             */
            priority: number;
            /**
             * Created At
             * @description When the learner asked, in seconds since the epoch.
             */
            created_at: number;
            /**
             * Ask
             * @description The query as the learner asked it.
             */
            ask: components["schemas"]["AskHierDemo"] | components["schemas"]["AskInspectFull"] | components["schemas"]["AskLabelHi"] | components["schemas"]["AskInspectLo"] | components["schemas"]["AskLabelLo"] | components["schemas"]["AskLabelFull"];
            /**
             * Answer
             * @description The answer that counts; null if there is none.
             */
            answer: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /** Answer Id */
            answer_id: number | null;
            /**
             * Used
             * @description Whether the learner has used the answer; a used answer can no longer be retracted.
             */
            used: boolean;
            /**
             * Annotator
             * @description The name of the user who answered, or who holds the query now.
             */
            annotator: string | null;
            /**
             * Units
             * @description The cost of the answer, in units.
             */
            units: number | null;
            /**
             * Seconds
             * @description The time from lease to answer, in seconds, by the server's clock.
             */
            seconds: number | null;
            /**
             * Active Seconds
             * @description The annotator's working time without idle time, in seconds.
             */
            active_seconds: number | null;
        };
        /**
         * QueryHistory
         * @description All assignments, ledger entries and comments of a query, oldest first, and its neighbors; sent by the server.
         */
        QueryHistory: {
            /** Assignments */
            assignments: components["schemas"]["PastAssignment"][];
            /** Ledger */
            ledger: components["schemas"]["LedgerEntry"][];
            /**
             * Comments
             * @description What reviewers wrote about the query.
             */
            comments: components["schemas"]["Comment"][];
            /**
             * Previous
             * @description The id of the previous query in the run, by episode and ordinal.
             */
            previous: number | null;
            /**
             * Next
             * @description The id of the next query in the run, by episode and ordinal.
             */
            next: number | null;
        };
        /**
         * QueryList
         * @description Queries of a run, newest first, sent by the server. For the next page, set `before` to the last query's id.
         */
        QueryList: {
            /** Queries */
            queries: components["schemas"]["Query"][];
        };
        /**
         * QueryPage
         * @description One page of a run's queries, newest first, sent by the server.
         */
        QueryPage: {
            /** Rows */
            rows: components["schemas"]["QueryRow"][];
            /**
             * Total
             * @description The number of queries on all pages.
             */
            total: number;
            /**
             * Newest
             * @description The id of the newest query on all pages.
             */
            newest: number | null;
            /**
             * Oldest
             * @description The id of the oldest query on all pages.
             */
            oldest: number | null;
        };
        /**
         * QueryRecord
         * @description A query with its answer and its whole history. (episode, ordinal) in `ask` identifies it in its run.
         */
        QueryRecord: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            record: "query";
            /**
             * State
             * @enum {string}
             */
            state: "open" | "leased" | "answered" | "cancelled";
            /**
             * Priority
             * @description Queries with a higher priority were handed out first.
             */
            priority: number;
            /**
             * Used
             * @description Whether the learner has used the answer.
             */
            used: boolean;
            /**
             * Created At
             * @description When the learner asked, in seconds since the epoch.
             */
            created_at: number;
            /**
             * Ask
             * @description The query as the learner asked it.
             */
            ask: components["schemas"]["AskHierDemo"] | components["schemas"]["AskInspectFull"] | components["schemas"]["AskLabelHi"] | components["schemas"]["AskInspectLo"] | components["schemas"]["AskLabelLo"] | components["schemas"]["AskLabelFull"];
            /** @description The assignment with the answer that counts. */
            answered: components["schemas"]["AssignmentRecord"] | null;
            /**
             * Earlier
             * @description All other assignments, oldest first.
             */
            earlier: components["schemas"]["AssignmentRecord"][];
        };
        /**
         * QueryRow
         * @description A query and its answer without the trajectory, as a row of a table; sent by the server.
         */
        QueryRow: {
            /** Id */
            id: number;
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Ordinal
             * @description The number of the query in the episode, from 0.
             */
            ordinal: number;
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /**
             * State
             * @enum {string}
             */
            state: "open" | "leased" | "answered" | "cancelled";
            /**
             * Priority
             * @description Queries with a higher priority are handed out first.
             */
            priority: number;
            /**
             * Question
             * @description The query in words.
             */
            question: string;
            /**
             * Created At
             * @description When the learner asked, in seconds since the epoch.
             */
            created_at: number;
            /**
             * Answered At
             * @description When the answer was given, in seconds since the epoch.
             */
            answered_at: number | null;
            /**
             * Answer
             * @description The answer that counts; null if there is none.
             */
            answer: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * Used
             * @description Whether the learner has used the answer.
             */
            used: boolean;
            /**
             * Annotator
             * @description The name of the user who answered, or who holds the query now.
             */
            annotator: string | null;
            /**
             * Units
             * @description The cost of the answer, in units.
             */
            units: number | null;
            /**
             * Seconds
             * @description The time from lease to answer, in seconds.
             */
            seconds: number | null;
            /**
             * Skips
             * @description How often annotators skipped the query.
             */
            skips: number;
            /**
             * Expiries
             * @description How many leases of the query expired.
             */
            expiries: number;
        };
        /**
         * Receipt
         * @description The server's reply to an answer: it is stored on disk and charged.
         */
        Receipt: {
            /**
             * Query
             * @description The id of the query.
             */
            query: number;
            /**
             * Answer
             * @description The id of the answer.
             */
            answer: number;
            /**
             * Units
             * @description The cost of the answer, in units.
             */
            units: number;
            /**
             * Seconds
             * @description The time from lease to answer, in seconds.
             */
            seconds: number;
            /**
             * Active Seconds
             * @description The annotator's working time without idle time, in seconds.
             */
            active_seconds: number;
            /** @description The next assignment, if one was requested and is available. */
            next: components["schemas"]["Assignment"] | null;
            /** @description The reason why no next query could be leased; null if none was requested or available. The answer is stored all the same. */
            next_problem: components["schemas"]["Problem"] | null;
        };
        /**
         * RecordPage
         * @description One page of a part of a run's records, sent by the server.
         */
        RecordPage: {
            /** Records */
            records: (components["schemas"]["QueryRecord"] | components["schemas"]["LedgerRecord"] | components["schemas"]["EpisodeRecord"])[];
            /**
             * Cursor
             * @description The cursor for the next page; null after the last record.
             */
            cursor: number | null;
        };
        /**
         * Release
         * @description A request to release an unanswered query, sent by its annotator.
         */
        Release: {
            /**
             * Token
             * @description The token of the assignment.
             */
            token: string;
            /**
             * Reason
             * @description The reason, shown in the history of the query; may be empty.
             * @default
             */
            reason: string;
            /**
             * Skip
             * @description Whether the query must not be leased to this annotator again.
             * @default false
             */
            skip: boolean;
        };
        /**
         * Renew
         * @description A request to renew a lease, sent regularly by an annotator.
         */
        Renew: {
            /**
             * Token
             * @description The token of the assignment.
             */
            token: string;
            /**
             * Active
             * @description Whether the annotator pressed a key, moved the pointer or scrolled since the last renewal.
             * @default false
             */
            active: boolean;
        };
        /**
         * Renewal
         * @description The server's reply to a renewal.
         */
        Renewal: {
            /**
             * Expires At
             * @description When the lease now expires, in seconds since the epoch.
             */
            expires_at: number;
        };
        /**
         * Retract
         * @description A request to retract an answer, sent by its annotator.
         */
        Retract: {
            /**
             * Token
             * @description The token of the assignment.
             */
            token: string;
            /**
             * Tab
             * @description The browser tab that will hold the query again.
             */
            tab?: string | null;
        };
        /**
         * Returned
         * @description An answer of the caller that a reviewer has sent back, sent by the server.
         */
        Returned: {
            /**
             * Query
             * @description The id of the query.
             */
            query: number;
            /**
             * Run
             * @description The id of the run.
             */
            run: string;
            /**
             * Run Name
             * @description The name of the run.
             */
            run_name: string;
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /**
             * Episode
             * @description The number of the episode in the run, from 0.
             */
            episode: number;
            /**
             * Question
             * @description The query in words.
             */
            question: string;
            /**
             * Answer
             * @description The answer that was sent back.
             */
            answer: components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
            /**
             * Answered At
             * @description When the answer was given, in seconds since the epoch.
             */
            answered_at: number;
            comment: components["schemas"]["Comment"];
        };
        /**
         * ReturnedList
         * @description The answers of the caller that were sent back, newest first; at most 100.
         */
        ReturnedList: {
            /** Returned */
            returned: components["schemas"]["Returned"][];
        };
        /**
         * ReviewPage
         * @description One page of answers under review, newest query first, sent by the server.
         */
        ReviewPage: {
            /** Rows */
            rows: components["schemas"]["ReviewRow"][];
            /**
             * Total
             * @description The number of answers on all pages.
             */
            total: number;
            /**
             * Newest
             * @description The id of the newest query on all pages.
             */
            newest: number | null;
            /**
             * Oldest
             * @description The id of the oldest query on all pages.
             */
            oldest: number | null;
        };
        /**
         * ReviewRow
         * @description An answered query under review, sent by the server, with what its answer is compared with.
         */
        ReviewRow: {
            query: components["schemas"]["QueryRow"];
            /**
             * Differs
             * @description Whether the answer differs from the learner's suggestion; null if the query had none.
             */
            differs: boolean | null;
            /** @description What the learner's policies would answer now; null if the learner has not sent it. */
            policy: components["schemas"]["Predicted"] | null;
            /**
             * Gold
             * @description For an answer to a gold query: its labels beside the correct ones; otherwise null.
             */
            gold: components["schemas"]["Mark"][] | null;
            /** @description The answer of a second annotator; null if there is none. */
            second: components["schemas"]["SecondAnswer"] | null;
        };
        /**
         * Run
         * @description A run and its account, sent by the server. `spent + reserved <= budget` holds at all times.
         */
        Run: {
            /** Id */
            id: string;
            /** Name */
            name: string;
            /** Algorithm */
            algorithm: string;
            /** Seed */
            seed: number;
            /**
             * State
             * @enum {string}
             */
            state: "running" | "paused" | "finished";
            vocabulary: components["schemas"]["Vocabulary"];
            /**
             * Config
             * @description All values that determine the run.
             */
            config: {
                [key: string]: components["schemas"]["JsonValue"];
            };
            prices: components["schemas"]["Prices"];
            /**
             * Budget
             * @description The highest total cost of the run, in units; null for no limit.
             */
            budget: number | null;
            /**
             * Reserved
             * @description The units reserved for unanswered queries.
             */
            reserved: number;
            /**
             * Spent
             * @description The units spent on answered queries.
             */
            spent: number;
            /**
             * Priority
             * @description Queries of a run with a higher priority are handed out first.
             */
            priority: number;
            /**
             * Episodes
             * @description The planned number of episodes; null if unknown.
             */
            episodes: number | null;
            /**
             * Episodes Done
             * @description The number of reported episodes.
             */
            episodes_done: number;
            /**
             * Success Rate
             * @description The success rate over the trailing 100 test episodes, 0 to 1; null before the first.
             */
            success_rate: number | null;
            /**
             * Open Queries
             * @description The number of unanswered queries.
             */
            open_queries: number;
            /**
             * Gold Rate
             * @description The share of gold queries among an annotator's queries, 0 to 0.5.
             */
            gold_rate: number;
            /**
             * Second Answers
             * @description The share of the run's queries that a second annotator answers as well, 0 to 1. A demonstration is never answered twice.
             * @default 0
             */
            second_answers: number;
            /**
             * Result
             * @description The learner's report at the end of the run.
             */
            result: {
                [key: string]: components["schemas"]["JsonValue"];
            } | null;
            /**
             * Created At
             * @description When the run was created, in seconds since the epoch.
             */
            created_at: number;
            /**
             * Finished At
             * @description When the run finished, in seconds since the epoch.
             */
            finished_at: number | null;
        };
        /**
         * RunCreate
         * @description The description of a new run, sent by the learner.
         */
        RunCreate: {
            /** Name */
            name: string;
            /** Algorithm */
            algorithm: string;
            /** Seed */
            seed: number;
            vocabulary: components["schemas"]["Vocabulary"];
            /**
             * Config
             * @description All values that determine the run.
             */
            config?: {
                [key: string]: components["schemas"]["JsonValue"];
            };
            prices?: components["schemas"]["PricesInput"];
            /**
             * Budget
             * @description The highest total cost of the run, in units; null for no limit.
             */
            budget?: number | null;
            /**
             * Episodes
             * @description The planned number of episodes.
             */
            episodes?: number | null;
            /**
             * Second Answers
             * @description The share of the run's queries that a second annotator answers as well, 0 to 1. A demonstration is never answered twice.
             * @default 0
             */
            second_answers: number;
        };
        /**
         * RunDeletion
         * @description What the deletion of a run deleted, or would delete, sent by the server. The counts include its gold queries.
         */
        RunDeletion: {
            /**
             * Run
             * @description The id of the run.
             */
            run: string;
            /**
             * Dry Run
             * @description Whether nothing was deleted, because the request only asked.
             */
            dry_run: boolean;
            /**
             * Queries
             * @description Queries that lose their content.
             */
            queries: number;
            /**
             * Answers
             * @description Answers that lose their content; their costs and times stay.
             */
            answers: number;
            /**
             * Gold
             * @description Known answers of gold queries.
             */
            gold: number;
            /**
             * Reasons
             * @description Assignments with a reason or the name of a browser tab.
             */
            reasons: number;
            /**
             * Comments
             * @description Comments on queries.
             */
            comments: number;
            /**
             * Events
             * @description Events.
             */
            events: number;
            /**
             * Episodes
             * @description Results of episodes.
             */
            episodes: number;
            /**
             * Messages
             * @description Delivered or given up webhook messages.
             */
            messages: number;
            /**
             * Frames
             * @description Pictures that no other run shows.
             */
            frames: number;
            /**
             * Frame Bytes
             * @description The size of these pictures.
             */
            frame_bytes: number;
            /**
             * Kept Entries
             * @description Entries of the ledger; they stay.
             */
            kept_entries: number;
            /**
             * Kept Units
             * @description The sum of these entries: what the run has spent, in units.
             */
            kept_units: number;
        };
        /**
         * RunList
         * @description One page of runs, sent by the server.
         */
        RunList: {
            /** Runs */
            runs: components["schemas"]["Run"][];
            /**
             * Total
             * @description The number of runs on all pages.
             */
            total: number;
        };
        /**
         * RunNews
         * @description A run that was created, paused, resumed or finished.
         */
        RunNews: {
            /**
             * Event
             * @description The id of the event in the run's event stream; it grows with every change.
             */
            event: number;
            /**
             * Run
             * @description The id of the run.
             */
            run: string;
            /**
             * Name
             * @description The name of the run at that time.
             */
            name: string;
            /**
             * State
             * @enum {string}
             */
            state: "running" | "paused" | "finished";
        };
        /**
         * RunOutlook
         * @description What the learner of a run does, and when it will ask again; sent by the server.
         */
        RunOutlook: {
            /**
             * Run
             * @description The id of the run.
             */
            run: string;
            /**
             * Name
             * @description The name of the run.
             */
            name: string;
            /**
             * Domain
             * @description The name of the run's domain.
             */
            domain: string;
            /**
             * Kinds
             * @description The kinds of query that the learner asked lately.
             */
            kinds: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full")[];
            /**
             * Demonstrations
             * @description How it asked for its last demonstrations: `hier_demo`, segments with subgoals; `flat_demo`, actions only; `play_on`, from a state where it failed.
             */
            demonstrations: ("hier_demo" | "flat_demo" | "play_on")[];
            /**
             * Doing
             * @description What the learner does: it waits for answers (`asking`), learns from them (`training`), or acts until it has something to ask (`rolling_out`); or it has neither asked nor reported anything yet (`nothing_yet`); or the run is paused or finished.
             * @enum {string}
             */
            doing: "nothing_yet" | "asking" | "training" | "rolling_out" | "paused" | "finished";
            /**
             * Seconds
             * @description How long ago the run changed last, in seconds.
             */
            seconds: number;
            /**
             * Usual Seconds
             * @description The median time from the last answer to the next query, over the last 20 times that no query was open, in seconds; null before the first.
             */
            usual_seconds: number | null;
            /**
             * Open
             * @description The number of unanswered queries, rounded up to tens; 1,000 for more.
             */
            open: number;
        };
        /**
         * RunPatch
         * @description Changes of a run. Absent fields do not change; a null budget removes the limit.
         */
        RunPatch: {
            /** Name */
            name?: string | null;
            /** State */
            state?: ("running" | "paused" | "finished") | null;
            /**
             * Budget
             * @description The highest total cost of the run, in units.
             */
            budget?: number | null;
            /**
             * Priority
             * @description Queries of a run with a higher priority are handed out first.
             */
            priority?: number | null;
            /**
             * Result
             * @description The learner's report at the end of the run.
             */
            result?: {
                [key: string]: components["schemas"]["JsonValue"];
            } | null;
            /** Gold Rate */
            gold_rate?: number | null;
            /** Second Answers */
            second_answers?: number | null;
        };
        /**
         * SecondAnswer
         * @description The answer of a second annotator to the same query, sent by the server. The learner never gets it.
         */
        SecondAnswer: {
            /**
             * Annotator
             * @description The name of the second annotator.
             */
            annotator: string;
            /** Answer */
            answer: components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
            /**
             * Units
             * @description What the answer would cost, in units; the run does not pay it.
             */
            units: number;
            /**
             * Seconds
             * @description The time from lease to answer, in seconds.
             */
            seconds: number;
        };
        /**
         * Segment
         * @description One segment (s_h, g_h, tau_h) of the learner's trajectory.
         */
        SegmentInput: {
            /**
             * Frames
             * @description One uploaded picture per state; empty if the web app draws the states itself. Pictures are not part of the query's content: the same query with other pictures is the same query.
             */
            frames?: string[];
            /**
             * Landmarks
             * @description Where subgoals are in the pictures: boxes by subgoal, one entry per state, or one for all states; empty if that is not known. Landmarks are not part of the query's content.
             */
            landmarks?: {
                [key: string]: components["schemas"]["Box"];
            }[];
            /**
             * Action Landmarks
             * @description Where actions lead in the pictures: boxes by action, one entry per state, or one for all states; empty if that is not known. They are not part of the query's content either.
             */
            action_landmarks?: {
                [key: string]: components["schemas"]["Box"];
            }[];
            /**
             * Subgoal
             * @description The learner's subgoal; null for a flat policy.
             */
            subgoal: string | null;
            /**
             * States
             * @description s_1 .. s_{H+1}, as JSON views of the domain.
             */
            states: components["schemas"]["JsonValue"][];
            /**
             * Actions
             * @description a_1 .. a_H, one fewer than the states.
             */
            actions: string[];
        };
        /**
         * Segment
         * @description One segment (s_h, g_h, tau_h) of the learner's trajectory.
         */
        Segment: {
            /**
             * Frames
             * @description One uploaded picture per state; empty if the web app draws the states itself. Pictures are not part of the query's content: the same query with other pictures is the same query.
             */
            frames: string[];
            /**
             * Landmarks
             * @description Where subgoals are in the pictures: boxes by subgoal, one entry per state, or one for all states; empty if that is not known. Landmarks are not part of the query's content.
             */
            landmarks: {
                [key: string]: components["schemas"]["Box"];
            }[];
            /**
             * Action Landmarks
             * @description Where actions lead in the pictures: boxes by action, one entry per state, or one for all states; empty if that is not known. They are not part of the query's content either.
             */
            action_landmarks: {
                [key: string]: components["schemas"]["Box"];
            }[];
            /**
             * Subgoal
             * @description The learner's subgoal; null for a flat policy.
             */
            subgoal: string | null;
            /**
             * States
             * @description s_1 .. s_{H+1}, as JSON views of the domain.
             */
            states: components["schemas"]["JsonValue"][];
            /**
             * Actions
             * @description a_1 .. a_H, one fewer than the states.
             */
            actions: string[];
        };
        /**
         * SendBack
         * @description A request to send an answer back, with the comment that says why; sent by a reviewer.
         */
        SendBack: {
            /**
             * Text
             * @description The comment; not only spaces.
             */
            text: string;
            /**
             * Answer
             * @description The id of the answer that the reviewer has seen.
             */
            answer: number;
        };
        /**
         * Session
         * @description A browser that is signed in, sent by the server.
         */
        Session: {
            /** Id */
            id: number;
            /**
             * Created At
             * @description When the user signed in, in seconds since the epoch.
             */
            created_at: number;
            /**
             * Last Used At
             * @description When the session was last used, in seconds since the epoch, to the minute.
             */
            last_used_at: number | null;
            /**
             * Expires At
             * @description When the session expires, in seconds since the epoch.
             */
            expires_at: number;
            /**
             * Current
             * @description Whether this is the session of the calling browser.
             */
            current: boolean;
        };
        /**
         * SessionList
         * @description The caller's sessions, oldest first, sent by the server.
         */
        SessionList: {
            /** Sessions */
            sessions: components["schemas"]["Session"][];
        };
        /**
         * SignInBegun
         * @description A sign-in that has begun, sent by the server.
         */
        SignInBegun: {
            /**
             * Url
             * @description The address at the OpenID provider that the browser opens next.
             */
            url: string;
        };
        /**
         * SignInOffer
         * @description The OpenID provider at which people may sign in, sent by the server.
         */
        SignInOffer: {
            /**
             * Provider
             * @description What the provider is called; null if there is none.
             */
            provider: string | null;
        };
        /**
         * SignInReply
         * @description The reply with which the OpenID provider sent a browser back, sent by that browser.
         */
        SignInReply: {
            /**
             * State
             * @description The `state` of the address.
             */
            state: string;
            /**
             * Code
             * @description The `code` of the address; null if the provider sent an error instead.
             */
            code?: string | null;
            /**
             * Issuer
             * @description The `iss` of the address, if it has one.
             */
            issuer?: string | null;
        };
        /**
         * Stuck
         * @description The queries of a run that are stuck, oldest first, sent by the server.
         */
        Stuck: {
            /**
             * Queries
             * @description The first 20.
             */
            queries: components["schemas"]["StuckQuery"][];
            /**
             * Total
             * @description How many there are.
             */
            total: number;
        };
        /**
         * StuckQuery
         * @description A query that is stuck, and why.
         */
        StuckQuery: {
            /**
             * Query
             * @description The id of the query.
             */
            query: number;
            /** Episode */
            episode: number;
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /**
             * Reasons
             * @description waiting: it has been open for more than 10 minutes. expired: two or more of its leases expired. skipped: every annotator of the last day who takes queries of its run and kind has skipped it.
             */
            reasons: ("waiting" | "expired" | "skipped")[];
            /**
             * Open Since
             * @description When it was asked, or when the last lease of it ended, in seconds since the epoch.
             */
            open_since: number;
            /**
             * Expiries
             * @description How many leases of the query expired.
             */
            expiries: number;
        };
        /**
         * Tally
         * @description The number and the cost of an annotator's answers, including gold queries, which no run pays for.
         */
        Tally: {
            /**
             * Answers
             * @description The number of answers.
             */
            answers: number;
            /**
             * Units
             * @description The cost of the answers, in units.
             */
            units: number;
        };
        /**
         * Token
         * @description A valid API token without its secret, sent by the server.
         */
        Token: {
            /** Id */
            id: number;
            /** Label */
            label: string;
            /**
             * Created At
             * @description When the token was created, in seconds since the epoch.
             */
            created_at: number;
            /**
             * Last Used At
             * @description When the token was last used, in seconds since the epoch, to the minute; null if never.
             */
            last_used_at: number | null;
            /**
             * Expires At
             * @description When it expires, in seconds since the epoch; null if it does not.
             */
            expires_at: number | null;
            /**
             * Scopes
             * @description What it may be used for; null for everything that the user may do.
             */
            scopes: ("read" | "answer" | "learn" | "manage")[] | null;
        };
        /**
         * TokenCreate
         * @description A request for an API token. Only administrators may request tokens of other users.
         */
        TokenCreate: {
            /**
             * User
             * @description The id of the token's user; null for the caller.
             */
            user?: number | null;
            /**
             * Label
             * @default
             */
            label: string;
            /**
             * Days
             * @description For how many days the token is valid; null until it is revoked.
             */
            days?: number | null;
            /**
             * Scopes
             * @description What the token may be used for, as far as its user may do it; every scope includes `read`. Null: everything.
             */
            scopes?: ("read" | "answer" | "learn" | "manage")[] | null;
        };
        /**
         * TokenList
         * @description A user's valid tokens, oldest first, sent by the server.
         */
        TokenList: {
            /** Tokens */
            tokens: components["schemas"]["Token"][];
        };
        /**
         * User
         * @description A user without secrets, sent by the server.
         */
        User: {
            /** Id */
            id: number;
            /** Name */
            name: string;
            /**
             * Role
             * @enum {string}
             */
            role: "admin" | "learner" | "annotator" | "viewer";
            /**
             * Created At
             * @description When the user was created, in seconds since the epoch.
             */
            created_at: number;
            /**
             * Deactivated At
             * @description When the user was deactivated, in seconds since the epoch; null for an active user.
             */
            deactivated_at: number | null;
            /**
             * Erased At
             * @description When the user's personal data were deleted, in seconds since the epoch; null if they were not.
             */
            erased_at: number | null;
            /**
             * Last Used At
             * @description When the user last called, in seconds since the epoch, to the minute; null if never.
             */
            last_used_at: number | null;
            /**
             * Frame Bytes
             * @description The size of the pictures that the user has uploaded.
             */
            frame_bytes: number;
        };
        /**
         * UserCreate
         * @description A new user (a person or a program), sent by an administrator.
         */
        UserCreate: {
            /** Name */
            name: string;
            /**
             * Role
             * @enum {string}
             */
            role: "admin" | "learner" | "annotator" | "viewer";
        };
        /**
         * UserErasure
         * @description What the deletion of a user's personal data deleted, or would delete beside the name, sent by the server.
         */
        UserErasure: {
            /**
             * User
             * @description The id of the user.
             */
            user: number;
            /**
             * Dry Run
             * @description Whether nothing was deleted, because the request only asked.
             */
            dry_run: boolean;
            /**
             * Credentials
             * @description Tokens, sessions and login links, with their labels and last uses.
             */
            credentials: number;
            /**
             * Comments
             * @description Comments that the user wrote.
             */
            comments: number;
            /**
             * Reasons
             * @description Assignments with a reason that the user gave, or the name of a browser tab.
             */
            reasons: number;
            /**
             * Traces
             * @description Notes of when the user was last at work, and in which tabs.
             */
            traces: number;
            /**
             * Kept Answers
             * @description Answers that count; they stay, without a name.
             */
            kept_answers: number;
            /**
             * Kept Units
             * @description The cost of these answers, in units.
             */
            kept_units: number;
        };
        /**
         * UserList
         * @description All users, sent by the server.
         */
        UserList: {
            /** Users */
            users: components["schemas"]["User"][];
        };
        /**
         * UserPatch
         * @description Changes of a user, sent by an administrator. Absent fields do not change.
         */
        UserPatch: {
            /** Role */
            role?: ("admin" | "learner" | "annotator" | "viewer") | null;
            /**
             * Active
             * @description False deactivates the user: sessions, tokens, login links and leases end; answers remain.
             */
            active?: boolean | null;
        };
        /**
         * Vocabulary
         * @description The names of a domain, in the order of its numbers, and the renderer that draws it in the web app.
         */
        Vocabulary: {
            /** Domain */
            domain: string;
            /**
             * Subgoals
             * @description The subgoals; empty for a domain without subgoals.
             */
            subgoals: string[];
            /**
             * Actions
             * @description The actions.
             */
            actions: string[];
            /**
             * Renderer
             * @description The renderer of the web app that draws its instances and states.
             */
            renderer: string;
        };
        /**
         * Webhook
         * @description A webhook without its secret, sent by the server.
         */
        Webhook: {
            /** Id */
            id: number;
            /** Url */
            url: string;
            /**
             * Topics
             * @description The changes that it announces.
             */
            topics: ("answer.accepted" | "answer.retracted" | "run.state")[];
            /** Note */
            note: string;
            /**
             * Active
             * @description Whether it is on. Nothing is queued for a webhook that is off.
             */
            active: boolean;
            /**
             * Off Reason
             * @description Why the server turned it off; null if the server did not.
             */
            off_reason: string | null;
            /**
             * Failing Since
             * @description When the first of the latest attempts failed, in seconds since the epoch; null if none failed.
             */
            failing_since: number | null;
            /**
             * Pending
             * @description The number of messages that wait for delivery.
             */
            pending: number;
            /**
             * Created At
             * @description When it was created, in seconds since the epoch.
             */
            created_at: number;
        };
        /**
         * WebhookAnswer
         * @description The body of a request to a receiver: an answer was accepted or retracted.
         */
        WebhookAnswer: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "answer.accepted" | "answer.retracted";
            /**
             * Timestamp
             * @description When the change happened, in UTC, as in ISO 8601.
             */
            timestamp: string;
            data: components["schemas"]["AnswerNews"];
        };
        /**
         * WebhookCreate
         * @description A new webhook, sent by an administrator.
         */
        WebhookCreate: {
            /**
             * Url
             * @description The https address of the receiver. The operator must have allowed its host.
             */
            url: string;
            /**
             * Topics
             * @description The changes to announce.
             * @default [
             *       "answer.accepted",
             *       "answer.retracted",
             *       "run.state"
             *     ]
             */
            topics: ("answer.accepted" | "answer.retracted" | "run.state")[];
            /**
             * Note
             * @default
             */
            note: string;
        };
        /**
         * WebhookList
         * @description All webhooks, oldest first, sent by the server.
         */
        WebhookList: {
            /** Webhooks */
            webhooks: components["schemas"]["Webhook"][];
        };
        /**
         * WebhookPatch
         * @description Changes of a webhook, sent by an administrator. Absent fields do not change.
         */
        WebhookPatch: {
            /** Url */
            url?: string | null;
            /**
             * Topics
             * @description The changes to announce.
             */
            topics?: ("answer.accepted" | "answer.retracted" | "run.state")[] | null;
            /** Note */
            note?: string | null;
            /**
             * Active
             * @description False turns the webhook off. True turns it on again and tries its pending messages at once.
             */
            active?: boolean | null;
        };
        /**
         * WebhookPing
         * @description The body of a request to a receiver: an administrator tests the webhook.
         */
        WebhookPing: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "ping";
            /**
             * Timestamp
             * @description When the change happened, in UTC, as in ISO 8601.
             */
            timestamp: string;
            data: components["schemas"]["PingNews"];
        };
        /**
         * WebhookRun
         * @description The body of a request to a receiver: a run has a new state.
         */
        WebhookRun: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "run.state";
            /**
             * Timestamp
             * @description When the change happened, in UTC, as in ISO 8601.
             */
            timestamp: string;
            data: components["schemas"]["RunNews"];
        };
        /**
         * WorkedDemonstration
         * @description A demonstration as a worked example, sent by the server. To practice one, a learner's environment is needed.
         */
        WorkedDemonstrationInput: {
            ask: components["schemas"]["AskHierDemoInput"];
            /** @description A good demonstration, with the states that were seen. The episode ends with it, unless it plays on where the learner failed. */
            answer: components["schemas"]["HierDemoAnswerInput"];
        };
        /**
         * WorkedDemonstration
         * @description A demonstration as a worked example, sent by the server. To practice one, a learner's environment is needed.
         */
        WorkedDemonstration: {
            ask: components["schemas"]["AskHierDemo"];
            /** @description A good demonstration, with the states that were seen. The episode ends with it, unless it plays on where the learner failed. */
            answer: components["schemas"]["HierDemoAnswer"];
        };
        /**
         * WorkedExample
         * @description A practice query with a correct answer, sent by the server; it is shown before others of its kind are asked.
         */
        WorkedExample: {
            /**
             * Query
             * @description The id of the practice query.
             */
            query: number;
            /** @description A correct answer, and the reason for each label. */
            feedback: components["schemas"]["Feedback"];
        };
        /**
         * PlayMoves
         * @description The whole demonstration so far, sent by the annotator to the learner.
         *
         *     It is sent as a whole, so neither side has to remember earlier messages. The learner compares it with the last one.
         */
        PlayMoves: {
            /**
             * Type
             * @constant
             */
            type: "moves";
            /**
             * Number
             * @description The number of this message; the reply repeats it.
             */
            number: number;
            /**
             * Segments
             * @description The segments as in the answer; empty before the first action.
             */
            segments: components["schemas"]["DemoSegment"][];
            /**
             * Known
             * @description The number of states that the annotator already has; the reply omits them.
             */
            known: number;
        };
        /**
         * PlayOffer
         * @description The learner's first message. It offers the environment of the query.
         */
        PlayOffer: {
            /**
             * Type
             * @constant
             */
            type: "offer";
        };
        /**
         * PlayStage
         * @description Sent by the server to the annotator: whether a learner offers the environment now.
         */
        PlayStage: {
            /**
             * Type
             * @constant
             */
            type: "stage";
            /**
             * Present
             * @description Whether a learner is connected.
             */
            present: boolean;
        };
        /**
         * PlayStates
         * @description The states after the annotator's actions, sent by the learner.
         */
        PlayStates: {
            /**
             * Frames
             * @description One uploaded picture per state; empty if the web app draws the states itself. Pictures are not part of the query's content: the same query with other pictures is the same query.
             */
            frames: string[];
            /**
             * Landmarks
             * @description Where subgoals are in the pictures: boxes by subgoal, one entry per state, or one for all states; empty if that is not known. Landmarks are not part of the query's content.
             */
            landmarks: {
                [key: string]: components["schemas"]["Box"];
            }[];
            /**
             * Action Landmarks
             * @description Where actions lead in the pictures: boxes by action, one entry per state, or one for all states; empty if that is not known. They are not part of the query's content either.
             */
            action_landmarks: {
                [key: string]: components["schemas"]["Box"];
            }[];
            /**
             * Type
             * @constant
             */
            type: "states";
            /**
             * Number
             * @description The number of the message that this one replies to.
             */
            number: number;
            /**
             * Known
             * @description The number of states before `states`.
             */
            known: number;
            /**
             * States
             * @description The following states up to the end of the episode, as JSON views of the domain.
             */
            states: components["schemas"]["JsonValue"][];
            /**
             * Ended
             * @description Whether the episode ended in the last state; later actions have no state.
             */
            ended: boolean;
            /**
             * Succeeded
             * @description Whether the whole task is accomplished in the last state.
             */
            succeeded: boolean;
        };
        /**
         * PlayTake
         * @description The annotator's first message. It proves that the annotator holds the query's live assignment.
         */
        PlayTake: {
            /**
             * Type
             * @constant
             */
            type: "take";
            /**
             * Assignment
             * @description The id of the assignment.
             */
            assignment: number;
            /**
             * Token
             * @description The token of the assignment.
             */
            token: string;
        };
    };
    responses: never;
    parameters: never;
    requestBodies: never;
    headers: never;
    pathItems: never;
}
export type $defs = Record<string, never>;
export interface operations {
    answer: {
        parameters: {
            query?: never;
            header?: {
                /** @description Names this attempt. Sending the same attempt again returns the same receipt. */
                "Idempotency-Key"?: string | null;
            };
            path: {
                assignment: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["AnswerPost"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Receipt"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Another annotator's assignment; Not the token of this assignment */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The lease has expired; The assignment has ended; The query was cancelled; The answer was taken back; Already there with other content; Idempotency-Key already used */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    answerBatch: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["AnswerBatch"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["BatchReceipt"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    retract: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                assignment: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Retract"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Assignment"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run's budget is exhausted */
            402: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Another annotator's assignment; Not the token of this assignment */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The assignment has ended; The learner has used the answer; The answer was taken back; The run is finished */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    myAssignments: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AssignmentList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    lease: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Lease"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Assignment"];
                };
            };
            /** @description There was no query within `wait` seconds. */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    leaseBatch: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["LeaseBatch"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AssignmentList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    leave: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Leave"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    renew: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                assignment: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Renew"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Renewal"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Another annotator's assignment; Not the token of this assignment */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The lease has expired; The assignment has ended */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    release: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                assignment: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Release"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Another annotator's assignment; Not the token of this assignment */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The lease has expired; The assignment has ended */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listQueries: {
        parameters: {
            query?: {
                state?: ("open" | "leased" | "answered" | "cancelled") | null;
                kind?: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full") | null;
                episode?: number | null;
                before?: number | null;
                limit?: number;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["QueryList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    ask: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["AskList"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Asked"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run's budget is exhausted */
            402: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Already there with other content; The run is finished */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many open queries */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getQuery: {
        parameters: {
            query?: {
                /** @description The longest time to wait for a change, in seconds. */
                wait?: number;
            };
            header?: never;
            path: {
                query: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Query"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listAnswers: {
        parameters: {
            query?: {
                after?: number;
                /** @description The longest time to wait for a change, in seconds. */
                wait?: number;
                limit?: number;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AnswerPage"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    useAnswer: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                query: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Query"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not answered */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listRuns: {
        parameters: {
            query?: {
                /** @description Words in the name, algorithm, domain or id. */
                text?: string;
                state?: ("running" | "paused" | "finished") | null;
                /** @description Only the runs with these ids. */
                run?: string[] | null;
                /** @description Only the runs that the caller created. */
                mine?: boolean;
                sort?: "newest" | "name" | "algorithm" | "episodes" | "success" | "cost";
                descending?: boolean;
                offset?: number;
                limit?: number;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createRun: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["RunCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Run"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getRun: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Run"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    deleteRun: {
        parameters: {
            query?: {
                /** @description Only say what would be deleted. */
                dry_run?: boolean;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunDeletion"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run is not finished */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    patchRun: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["RunPatch"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Run"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run is finished; The budget is too low */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    reportEpisodes: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["EpisodeList"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Run"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Already there with other content; The run is finished */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getCurves: {
        parameters: {
            query?: {
                /** @description Only the episodes after this one. */
                after?: number;
                /** @description With more rows than this, only the last and every n-th before it. */
                most?: number | null;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Curves"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getCosts: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Costs"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getForecast: {
        parameters: {
            query?: {
                /** @description The success rate over 100 test episodes. */
                target?: "0.8" | "0.9" | "0.95" | "0.99";
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Forecast"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listQueryRows: {
        parameters: {
            query?: {
                state?: ("open" | "leased" | "answered" | "cancelled") | null;
                kind?: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full") | null;
                episode?: number | null;
                annotator?: string | null;
                /** @description Words, each of which is in the question, a comment, a reason to skip, or the annotator's name. */
                text?: string;
                /** @description Only rows older than this one. */
                before?: number | null;
                /** @description The oldest rows that are newer than this one. */
                after?: number | null;
                limit?: number;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["QueryPage"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listLedger: {
        parameters: {
            query?: {
                kind?: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full") | null;
                entry?: ("charge" | "refund") | null;
                /** @description Only rows older than this one. */
                before?: number | null;
                /** @description The oldest rows that are newer than this one. */
                after?: number | null;
                limit?: number;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LedgerPage"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listRecords: {
        parameters: {
            query: {
                part: "queries" | "ledger" | "episodes";
                /** @description The cursor of the page before. */
                after?: number | null;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RecordPage"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getHistory: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                query: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["QueryHistory"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listStuck: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Stuck"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listAtWork: {
        parameters: {
            query?: {
                run?: string | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AtWorkList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getOutlook: {
        parameters: {
            query?: {
                run?: string | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Outlook"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    exportRun: {
        parameters: {
            query?: {
                table?: "curves" | "ledger" | "queries";
                format?: "csv" | "jsonl";
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The table, one row per line. */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": unknown;
                    "application/jsonl": unknown;
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    streamEvents: {
        parameters: {
            query?: {
                /** @description Only events after this id; without it, only new events. */
                after?: number | null;
            };
            header?: {
                "last-event-id"?: string | null;
            };
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Server-sent events; each `data` is an Event. */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/event-stream": unknown;
                    "application/json": components["schemas"]["Event"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    streamChanges: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Server-sent events; each `data` is a Change. */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/event-stream": unknown;
                    "application/json": components["schemas"]["Change"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    putFrames: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FrameUpload"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many pictures */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    missingFrames: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FrameHashes"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["FrameHashes"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getFrame: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description The SHA-256 of the PNG. */
                frame: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The picture. */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "image/png": unknown;
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listUsers: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["UserList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createUser: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["UserCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["User"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The name is taken */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getUser: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                user: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["User"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    eraseUser: {
        parameters: {
            query?: {
                /** @description Only say what would be deleted. */
                dry_run?: boolean;
            };
            header?: never;
            path: {
                user: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["UserErasure"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The user is active; The user's data were deleted */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    patchUser: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                user: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["UserPatch"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["User"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The user's data were deleted; The last administrator stays */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createLoginLink: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                user: number;
            };
            cookie?: never;
        };
        requestBody?: {
            content: {
                "application/json": components["schemas"]["LoginLinkCreate"] | null;
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LoginLink"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The user is deactivated */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listTokens: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                user: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TokenList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getNumbers: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                user: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Numbers"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listNumbers: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["NumbersList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createToken: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["TokenCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["NewToken"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The user is deactivated */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    revokeToken: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                token: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    login: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Login"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Me"];
                };
            };
            /** @description Log in first; The login link was used before; The login link is too old; The account is deactivated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many attempts */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    logout: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    me: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Me"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    myNumbers: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Numbers"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    myTokens: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TokenList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    mySessions: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SessionList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    logoutEverywhere: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getSignIn: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SignInOffer"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    beginSignIn: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SignInBegun"];
                };
            };
            /** @description Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The provider of sign-ins failed */
            502: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    endSignIn: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["SignInReply"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Me"];
                };
            };
            /** @description Begin the sign-in again; The sign-in failed; No account on this server; No role on this server; The account is deactivated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The provider of sign-ins failed */
            502: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listGold: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["GoldList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    addGold: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["GoldPost"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["GoldList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not answered */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    retireGold: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
                item: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listReview: {
        parameters: {
            query?: {
                kind?: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full") | null;
                annotator?: string | null;
                /** @description Only answers that differ from the learner's suggestion, from what its policies would answer now, or from a second answer, or those to gold queries whose first labels were not all correct. Only the last filter finds answers to gold queries. */
                disagrees?: ("suggestion" | "policy" | "gold" | "second") | null;
                /** @description Only rows older than this one. */
                before?: number | null;
                /** @description The oldest rows that are newer than this one. */
                after?: number | null;
                limit?: number;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ReviewPage"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    putPredictions: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Predictions"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getAgreement: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Agreement"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    comment: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                query: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["CommentPost"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Comment"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    sendBack: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                query: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["SendBack"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Comment"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run's budget is exhausted */
            402: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description This answer stays as it is; The answer was taken back; The learner has used the answer; The run is finished */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    myReturned: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ReturnedList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getPractice: {
        parameters: {
            query?: {
                /** @description The domain to practice; the first of all if absent. */
                domain?: string | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Practice"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    practice: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                query: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PracticeAnswer"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Feedback"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    putPractice: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PracticePut"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listWebhooks: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["WebhookList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createWebhook: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["WebhookCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["NewWebhook"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getWebhook: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                webhook: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Webhook"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    deleteWebhook: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                webhook: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    patchWebhook: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                webhook: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["WebhookPatch"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Webhook"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    pingWebhook: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                webhook: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            202: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Delivery"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The webhook is off */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listDeliveries: {
        parameters: {
            query?: {
                state?: ("pending" | "delivered" | "given_up") | null;
                /** @description Only messages older than this one. */
                before?: number | null;
                limit?: number;
            };
            header?: never;
            path: {
                webhook: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["DeliveryPage"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    redeliver: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                webhook: number;
                delivery: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            202: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Delivery"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The webhook is off */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listAudit: {
        parameters: {
            query?: {
                actor?: string | null;
                action?: ("login" | "login.refused" | "logout" | "link.created" | "permission.refused" | "run.deleted" | "token.created" | "token.revoked" | "user.created" | "user.identified" | "user.role_changed" | "user.deactivated" | "user.reactivated" | "user.erased") | null;
                /** @description From this time on, in seconds since the epoch. */
                since?: number | null;
                /** @description Before this time, in seconds since the epoch. */
                until?: number | null;
                /** @description Only rows older than this one. */
                before?: number | null;
                /** @description The oldest rows that are newer than this one. */
                after?: number | null;
                limit?: number;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AuditPage"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    exportAudit: {
        parameters: {
            query?: {
                format?: "csv" | "jsonl";
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description One row per line. */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": unknown;
                    "application/jsonl": unknown;
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    healthz: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Health"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    readyz: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Health"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The server is stopping */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    metrics: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/plain": string;
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed; The store is busy */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    webhook: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["WebhookAnswer"] | components["schemas"]["WebhookRun"] | components["schemas"]["WebhookPing"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": unknown;
                };
            };
        };
    };
}
